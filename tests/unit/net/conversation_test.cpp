#include "unit/net/conversation_fixture.h"

namespace froxel::net {
namespace {

using protocol::CloseCode;

TEST_F(ConversationTest, Hello_Serving_WelcomesAndGrantsCredit) {
    serve();
    hello();
    EXPECT_EQ(nextAnswer()->welcome().session_id(), 7U);
    EXPECT_GT(port_.session().granted, 0U);
    EXPECT_EQ(talk_.maxMessageBytes(), protocol::kMaxMessageBytes);
}

TEST_F(ConversationTest, Hello_Loading_WaitsAndKeepsCommandsInOrder) {
    ServiceStatus loading;
    loading.loading = {"moving in", 0.5};
    talk_.onService(loading, now_);
    hello();
    EXPECT_EQ(nextAnswer()->loading().stage(), "moving in");
    setExposure(2);
    const uint64_t seq = setExposure(3);
    EXPECT_TRUE(port_.sessions.empty());
    serve();
    EXPECT_TRUE(nextAnswer()->has_welcome());
    EXPECT_EQ(nextAnswer()->state().ref_seq(), seq);
    EXPECT_FLOAT_EQ(port_.session().states.back().settings.exposure, 3);
}

TEST_F(ConversationTest, Command_WhileLoadingBeyondTheCap_IsRefused) {
    talk_.onService({}, now_);
    hello();
    for (size_t i = 0; i < Conversation::kMaxEarlyCommands; ++i) {
        setExposure(1);
    }
    drainAnswers();
    const uint64_t seq = setExposure(1);
    const auto error = nextAnswer()->error();
    EXPECT_EQ(error.code(), v1::ERROR_CODE_CAPACITY);
    EXPECT_EQ(error.ref_seq(), seq);
}

TEST_F(ConversationTest, Hello_NoSessionLeft_IsToldAndCloses) {
    port_.full = true;
    serve();
    hello();
    EXPECT_EQ(nextAnswer()->error().code(), v1::ERROR_CODE_CAPACITY);
    EXPECT_FALSE(nextAnswer());
    EXPECT_EQ(talk_.closing()->code, CloseCode::kDeviceBusy);
}

TEST_F(ConversationTest, Commands_BeforeTheAnswerIsWritten_AreAnsweredOnce) {
    join();
    setExposure(2);
    setExposure(3);
    const uint64_t seq = setExposure(4);
    const auto answer = nextAnswer()->state();
    EXPECT_EQ(answer.ref_seq(), seq);
    EXPECT_DOUBLE_EQ(answer.state().exposure(), 4);
    EXPECT_FALSE(nextAnswer());
    EXPECT_EQ(port_.session().states.size(), 4U);
}

// A camera that is dragged says 60 commands a second; a state answers all that came before it.
TEST_F(ConversationTest, States_OfAFloodOfCommands_AreFewAndTheLastSaysAll) {
    join();
    const auto due_in_a_second = [this] {
        int states = 0;
        for (int i = 0; i < 60; ++i, now_ += 16667us) {
            setExposure(1 + i / 100.0);
            for (auto answer = nextAnswer(); answer; answer = nextAnswer()) {
                states += answer->has_state() ? 1 : 0;
            }
        }
        return states;
    };
    EXPECT_LE(due_in_a_second(), Conversation::kStatesAtOnce + Conversation::kStatesPerSecond);
    EXPECT_LE(due_in_a_second(), Conversation::kStatesPerSecond + 1);
    uint64_t last = setExposure(7);
    while (nextAnswer()) {
        last = setExposure(7);
    }
    const auto wake = talk_.wakeAt(now_);
    ASSERT_TRUE(wake);
    EXPECT_LE(*wake - now_, 200ms);
    now_ = *wake;
    const v1::StateChanged state = nextAnswer().value().state();
    EXPECT_EQ(state.ref_seq(), last);
    EXPECT_DOUBLE_EQ(state.state().exposure(), 7);
    EXPECT_FALSE(talk_.wakeAt(now_)) << "nothing waits";
}

TEST_F(ConversationTest, PlacedLights_AreToldByChanges) {
    join();
    const auto place = [this](uint32_t id) {
        v1::ClientMessage message;
        v1::PlacedLight& light = *message.mutable_set_placed_lights()->add_lights();
        light.set_id(id);
        light.mutable_position();
        say(message);
    };
    place(1);
    EXPECT_EQ(nextAnswer()->state().placed_lights().lights_size(), 1);
    setExposure(2);
    EXPECT_FALSE(nextAnswer()->state().has_placed_lights());
    place(2);
    place(3); // answered together
    const auto change = nextAnswer()->state().placed_lights();
    ASSERT_EQ(change.lights_size(), 2);
    EXPECT_EQ(change.lights(0).id(), 2U);
}

TEST_F(ConversationTest, Command_OutOfRange_KeepsTheState) {
    join();
    setExposure(-1);
    EXPECT_EQ(nextAnswer()->error().field(), "exposure");
    EXPECT_EQ(port_.session().states.size(), 1U);
}

TEST_F(ConversationTest, Frames_WindowIsFull_WaitAndTheNewestIsSent) {
    join();
    frame(1);
    EXPECT_EQ(nextFrame().frame_id(), 1U);
    frame(2);
    EXPECT_EQ(nextFrame().frame_id(), 2U);
    frame(3);
    frame(4);
    EXPECT_FALSE(talk_.nextMessage(now_)) << "two are unacknowledged";
    EXPECT_EQ(port_.session().granted, 4U) << "no more than those that came";
    ack(1);
    const auto header = nextFrame();
    EXPECT_EQ(header.frame_id(), 4U);
    EXPECT_EQ(header.dropped_frames(), 1U);
}

TEST_F(ConversationTest, Frame_WaitedInTheSlot_TellsHowLong) {
    join();
    frame(1);
    now_ += 3ms;
    EXPECT_EQ(nextFrame().send_wait_us(), 3000U);
}

std::shared_ptr<const FrameDetails> detailsOf(const char* line) {
    return std::make_shared<const FrameDetails>(FrameDetails{{line}, {{"textures", 7}}, {}});
}

TEST_F(ConversationTest, Details_News_GoBeforeTheFirstFrameThatTheyAreTrueOf) {
    join();
    const auto first = detailsOf("first");
    frame(1, first);
    EXPECT_EQ(nextAnswer()->details().plan(0), "first");
    EXPECT_EQ(nextFrame().frame_id(), 1U);
    frame(2, first);
    EXPECT_EQ(nextFrame().frame_id(), 2U) << "they hold until the next ones";
    ack(2);
    frame(3, detailsOf("second"));
    EXPECT_EQ(nextAnswer()->details().plan(0), "second");
    EXPECT_EQ(nextFrame().frame_id(), 3U);
}

TEST_F(ConversationTest, Details_OfAFrameThatWasReplaced_AreNotSent) {
    join();
    frame(1, detailsOf("replaced"));
    frame(2, detailsOf("sent"));
    EXPECT_EQ(nextAnswer()->details().plan(0), "sent");
    EXPECT_EQ(nextFrame().frame_id(), 2U);
}

TEST_F(ConversationTest, Details_ReplacedBetweenThemAndTheirFrame_AreFollowedByTheNewOnes) {
    join();
    frame(1, detailsOf("old"));
    EXPECT_EQ(nextAnswer()->details().plan(0), "old");
    frame(2, detailsOf("new"));
    EXPECT_EQ(nextAnswer()->details().plan(0), "new");
    EXPECT_EQ(nextFrame().frame_id(), 2U);
}

TEST_F(ConversationTest, Ack_OfAFrameNeverSent_IsAnError) {
    join();
    const uint64_t seq = ack(5);
    EXPECT_EQ(nextAnswer()->error().ref_seq(), seq);
}

// Frames that credit holds back and that take longer on the link than they should come.
TEST_F(ConversationTest, SlowLink_StepsDownAndTellsTheStreamAndTheHeaders) {
    join();
    uint64_t sent = 0;
    uint64_t acked = 0;
    const auto send = [&] {
        frame(++sent);
        const v1::FrameHeader header = nextFrame();
        EXPECT_EQ(header.frame_id(), sent);
        return header;
    };
    for (int i = 0; i < 5; ++i) { // a fast one, for the base
        send();
        now_ += 2ms;
        ack(++acked);
        now_ += 58ms;
    }
    EXPECT_EQ(port_.session().delivery.rung, 0U);
    send();
    send();
    for (int i = 0; i < 8; ++i) {
        now_ += 200ms;
        ack(++acked);
        if (port_.session().delivery.rung > 0) {
            break; // the next one travels alone
        }
        send();
    }
    EXPECT_GT(port_.session().delivery.rung, 0U);
    EXPECT_LT(port_.session().delivery.quality_max, 80U);
    EXPECT_TRUE(port_.session().delivery.link_rate);
    EXPECT_EQ(port_.session().states.size(), 1U) << "what was asked for stays";
    EXPECT_NE(metrics_->text().find("froxel_rate_steps_total{reason=\"congested\"} 1\n"),
              std::string::npos);
}

TEST_F(ConversationTest, Ack_AgainAndAgain_IsNoErrorAndGrantsNoMore) {
    join();
    frame(1);
    nextFrame();
    ack(1);
    const uint64_t granted = port_.session().granted;
    for (int i = 0; i < 10'000; ++i) {
        ack(1);
    }
    EXPECT_EQ(port_.session().granted, granted);
    EXPECT_FALSE(nextAnswer());
}

TEST_F(ConversationTest, Rejects_TooMany_CloseWithPolicyAfterSayingSo) {
    join();
    for (uint32_t i = 0; i <= protocol::kMaxRejects; ++i) {
        EXPECT_FALSE(talk_.closing());
        setExposure(-1);
    }
    EXPECT_EQ(talk_.closing()->code, CloseCode::kPolicy);
    v1::ServerMessage last;
    while (const auto answer = nextAnswer()) {
        last = *answer;
    }
    EXPECT_EQ(last.error().code(), v1::ERROR_CODE_RATE_LIMIT);
}

TEST_F(ConversationTest, Pings_AnswersAreNotTaken_ClosesAsSlow) {
    join();
    for (size_t i = 0; i <= Outbox::kMaxAnswers; ++i) {
        v1::ClientMessage ping;
        ping.mutable_ping();
        say(ping);
    }
    EXPECT_EQ(talk_.closing()->code, CloseCode::kSlowConsumer);
}

// It may find a better way: its session waits for it. One that misbehaved has left.
TEST_F(ConversationTest, Departure_OfASlowViewer_KeepsItsSession_OfAnOffenderNot) {
    const auto leaves = [this](bool slow) {
        const session::SessionId id = FakePort::kFirstId + port_.sessions.size();
        const auto viewer = std::make_shared<Viewer>();
        std::optional<Conversation> talk;
        talk.emplace(viewer, lobby_, metrics_, Caller{{"192.0.2.7"}, false, {}});
        viewer->talk = &*talk;
        ServiceStatus status;
        status.serving = Serving{std::make_shared<const session::SessionContext>(), &port_};
        talk->onService(status, now_);
        uint64_t seq = 0;
        const auto tell = [&](v1::ClientMessage message) {
            message.set_seq(++seq);
            talk->onMessage(protocol::bytesOf(message.SerializeAsString()), WireFormat::kBinary,
                            now_);
        };
        v1::ClientMessage hello;
        hello.mutable_hello()->set_protocol_major(protocol::kMajor);
        tell(hello);
        while (talk->nextMessage(now_)) {
        }
        v1::ClientMessage message;
        if (slow) {
            message.mutable_ping();
        } else {
            message.mutable_set_exposure()->set_exposure(-1);
        }
        while (!talk->closing()) {
            tell(message);
        }
        EXPECT_EQ(talk->closing()->code, slow ? CloseCode::kSlowConsumer : CloseCode::kPolicy);
        talk.reset();
        return port_.session(id).left;
    };
    EXPECT_FALSE(leaves(true));
    EXPECT_TRUE(leaves(false));
}

TEST_F(ConversationTest, Refused_PictureTooLarge_FallsBackToWhatWasDrawn) {
    join();
    const session::SessionState drawn = port_.session().states.back();
    v1::ClientMessage large;
    large.mutable_set_size()->set_width(4096);
    large.mutable_set_size()->set_height(4096);
    const uint64_t seq = say(large);
    const session::SessionState refused = port_.session().states.back();
    drainAnswers();
    port_.sink()->refuse({ErrorCode::kCapacity, "too large"}, refused, drawn);
    EXPECT_EQ(nextAnswer()->error().ref_seq(), seq);
    EXPECT_EQ(nextAnswer()->state().state().width(), drawn.settings.size.width_px);
    EXPECT_EQ(port_.session().states.back().settings.size, drawn.settings.size);
    EXPECT_GT(port_.session().states.back().version, refused.version);
}

TEST_F(ConversationTest, Refused_StateChangedMeanwhile_LeavesItToTheStream) {
    join();
    const session::SessionState refused = port_.session().states.back();
    setExposure(2);
    drainAnswers();
    port_.sink()->refuse({ErrorCode::kCapacity, "too large"}, refused, refused);
    EXPECT_FALSE(nextAnswer());
}

TEST_F(ConversationTest, Refused_DeviceCannot_SaysUnsupportedAndGoesOn) {
    join();
    const session::SessionState drawn = port_.session().states.back();
    const uint64_t seq = setExposure(2);
    drainAnswers();
    port_.sink()->refuse({ErrorCode::kUnsupported, "no"}, port_.session().states.back(), drawn);
    const auto error = nextAnswer()->error();
    EXPECT_EQ(error.code(), v1::ERROR_CODE_UNSUPPORTED);
    EXPECT_EQ(error.ref_seq(), seq);
    EXPECT_DOUBLE_EQ(nextAnswer()->state().state().exposure(), 1);
    EXPECT_FALSE(talk_.closing());
}

TEST_F(ConversationTest, Refused_BeforeTheFirstPicture_FallsBackToWelcome) {
    join();
    const session::SessionState first = port_.session().states.back();
    setExposure(2);
    drainAnswers();
    port_.sink()->refuse({ErrorCode::kUnsupported, "no"}, port_.session().states.back(), {});
    EXPECT_TRUE(nextAnswer()->has_error());
    EXPECT_EQ(port_.session().states.back().settings, first.settings);
    EXPECT_FALSE(talk_.closing());
}

TEST_F(ConversationTest, Refused_FirstPicture_Closes) {
    join();
    port_.sink()->refuse({ErrorCode::kCapacity, "too large"}, port_.session().states.back(), {});
    EXPECT_EQ(talk_.closing()->code, CloseCode::kNoPicture);
}

TEST_F(ConversationTest, Draining_WithASession_SaysSoOnceAndGoesOnUntilItIsOver) {
    join();
    ServiceStatus status;
    status.draining = Draining{5000ms, "wss://b.example/ws"};
    talk_.onService(status, now_);
    const auto told = nextAnswer()->draining();
    EXPECT_EQ(told.deadline_ms(), 5000U);
    EXPECT_EQ(told.reconnect_url(), "wss://b.example/ws");
    frame(1);
    EXPECT_EQ(nextFrame().frame_id(), 1U);
    EXPECT_FALSE(talk_.closing());
    status.draining->over = true;
    talk_.onService(status, now_);
    EXPECT_FALSE(talk_.nextMessage(now_));
    EXPECT_EQ(talk_.closing()->code, CloseCode::kDraining);
}

TEST_F(ConversationTest, Draining_WithoutASession_ClosesAtOnce) {
    ServiceStatus status;
    status.draining = Draining{};
    talk_.onService(status, now_);
    EXPECT_TRUE(nextAnswer()->has_draining());
    EXPECT_EQ(talk_.closing()->code, CloseCode::kDraining);
}

TEST_F(ConversationTest, Lost_SaysWhyAndCloses) {
    join();
    ServiceStatus status;
    status.lost = "the render thread stands still";
    talk_.onService(status, now_);
    EXPECT_EQ(nextAnswer()->error().message(), "the render thread stands still");
    EXPECT_EQ(talk_.closing()->code, CloseCode::kDeviceLost);
}

TEST_F(ConversationTest, HelloTimeout_NoHello_Closes) {
    talk_.onHelloTimeout();
    EXPECT_EQ(talk_.closing()->code, CloseCode::kPolicy);
}

TEST_F(ConversationTest, HelloTimeout_Greeted_ChangesNothing) {
    join();
    talk_.onHelloTimeout();
    EXPECT_FALSE(talk_.closing());
}

TEST(ConversationEnd, AfterWelcome_LeavesTheStream) {
    FakePort port;
    {
        Conversation talk{{}, std::make_shared<Lobby>(LobbyRules{}), std::make_shared<Metrics>()};
        ServiceStatus status;
        status.serving = Serving{std::make_shared<const session::SessionContext>(), &port};
        talk.onService(status, TimePoint());
        v1::ClientMessage hello;
        hello.set_seq(1);
        hello.mutable_hello()->set_protocol_major(protocol::kMajor);
        talk.onMessage(protocol::bytesOf(hello.SerializeAsString()), WireFormat::kBinary,
                       TimePoint());
    }
    EXPECT_TRUE(port.session().left);
}

} // namespace
} // namespace froxel::net

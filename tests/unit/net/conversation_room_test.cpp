// Pausing, rooms and resuming, as one connection sees them.
#include "unit/net/conversation_fixture.h"

#include <limits>

namespace froxel::net {
namespace {

using protocol::CloseCode;

v1::ClientMessage pausing(bool paused) {
    v1::ClientMessage message;
    message.mutable_pause()->set_paused(paused);
    return message;
}

TEST_F(ConversationTest, Pause_HoldsPicturesBack_AndTheNewestComesAtItsEnd) {
    join();
    frame(1);
    EXPECT_EQ(nextFrame().frame_id(), 1U);
    ack(1);
    say(pausing(true));
    EXPECT_EQ(port_.session().granted, 1U) << "nothing is drawn";
    frame(2); // were on their way, or another viewer of the room wanted them
    frame(3);
    EXPECT_FALSE(talk_.nextMessage(now_));
    EXPECT_EQ(port_.session().granted, 3U);
    say(pausing(true));
    say(pausing(false));
    EXPECT_EQ(nextFrame().frame_id(), 3U);
    EXPECT_GT(port_.session().granted, 3U);
    EXPECT_FALSE(talk_.closing());
}

TEST_F(ConversationTest, Pause_BegunAndEndedAgainAndAgain_IsRefused_AndThePauseStaysAsItWas) {
    join();
    for (int i = 0; i < 100; ++i) {
        say(pausing(true)); // said again, it changes nothing
    }
    for (int i = 1; i < Conversation::kPausesAtOnce; ++i) {
        say(pausing(i % 2 == 0));
    }
    EXPECT_FALSE(nextAnswer());
    say(pausing(true));
    EXPECT_EQ(nextAnswer().value().error().message(), "more than 5 pauses begun or ended a second");
    frame(1);
    EXPECT_EQ(nextFrame().frame_id(), 1U) << "it goes on";
    now_ += 200ms;
    say(pausing(true));
    frame(2);
    EXPECT_FALSE(talk_.nextMessage(now_)) << "paused";
}

TEST_F(ConversationTest, Frame_EchoesOwnCommandsOnly) {
    join();
    const uint64_t seq = setExposure(2);
    drainAnswers();
    port_.deliver(1, now_);
    v1::FrameHeader header = nextFrame();
    EXPECT_EQ(header.applied_seq(), seq);
    EXPECT_EQ(header.queue_us(), 1000U);
    ack(1);
    port_.session().states.back().applied = {99, 5, 1234}; // another connection's
    port_.deliver(2, now_);
    header = nextFrame();
    EXPECT_EQ(header.applied_seq(), seq) << "the newest own one that is shown";
    EXPECT_EQ(header.queue_us(), 0U) << "waited for by someone else";
}

// As after a very long time: neither wraps, neither stalls.
TEST_F(ConversationTest, IdsNearTheirLimits_Work) {
    constexpr uint64_t kLast = std::numeric_limits<uint64_t>::max();
    join();
    seq_ = kLast - 4;
    for (const uint64_t id : {kLast - 2, kLast - 1, kLast}) {
        port_.deliver(id, now_);
        EXPECT_EQ(nextFrame().frame_id(), id);
        ack(id);
        EXPECT_FALSE(talk_.nextMessage(now_)) << "no error";
    }
    EXPECT_EQ(setExposure(2), kLast);
    EXPECT_EQ(nextAnswer()->state().ref_seq(), kLast);
    seq_ = 0;
    setExposure(3);
    EXPECT_EQ(nextAnswer()->error().field(), "seq");
}

TEST_F(ConversationTest, ControlRefusals_NeverCloseTheConnection) {
    serve();
    v1::ClientMessage message;
    message.mutable_hello()->set_protocol_major(protocol::kMajor);
    message.mutable_hello()->set_room("hall");
    auto first = lobby_->enter({std::make_shared<const session::SessionContext>(), &port_},
                               {1, 0, "", "hall", ""}, {}, {}, now_);
    say(message);
    drainAnswers();
    for (uint32_t i = 0; i < 10 * protocol::kMaxRejects; ++i) {
        const uint64_t seq = setExposure(2);
        const auto error = nextAnswer()->error();
        EXPECT_EQ(error.code(), v1::ERROR_CODE_CONTROL);
        EXPECT_EQ(error.ref_seq(), seq);
    }
    EXPECT_FALSE(talk_.closing());
}

TEST_F(ConversationTest, TakenOver_IsToldWithItsCode) {
    serve();
    hello();
    const std::string token = nextAnswer()->welcome().resume_token();
    ASSERT_EQ(token.size(), 64U);
    const auto newer = lobby_->enter({std::make_shared<const session::SessionContext>(), &port_},
                                     {1, 0, "", "", token}, {}, {}, now_);
    EXPECT_TRUE(newer->resumed);
    EXPECT_EQ(talk_.closing()->code, CloseCode::kReplaced);
}

} // namespace
} // namespace froxel::net

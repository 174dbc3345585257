// Several viewers of one session, lost connections that come back, and crowds.
#include "integration/eventually.h"
#include "integration/http_exchange.h"
#include "integration/test_server.h"
#include "integration/ws_client.h"

#include <boost/system/system_error.hpp>
#include <gtest/gtest.h>

#include <atomic>
#include <deque>
#include <thread>

namespace froxel::test {
namespace {

using namespace std::chrono_literals;
using v1::ClientMessage;
using v1::ServerMessage;

ClientMessage setExposure(double exposure) {
    ClientMessage message;
    message.mutable_set_exposure()->set_exposure(exposure);
    return message;
}

ClientMessage requestControl() {
    ClientMessage message;
    message.mutable_request_control();
    return message;
}

ClientMessage giveControl(uint64_t member) {
    ClientMessage message;
    message.mutable_give_control()->set_member_id(member);
    return message;
}

ClientMessage pause(bool paused) {
    ClientMessage message;
    message.mutable_pause()->set_paused(paused);
    return message;
}

v1::RoomState roomWith(WsClient& client, const std::function<bool(const v1::RoomState&)>& wanted) {
    for (;;) {
        const auto room = client.expect(ServerMessage::kRoomState).room_state();
        if (wanted(room)) {
            return room;
        }
    }
}

TEST(Rooms, TwoViewers_OneRender_SamePictures) {
    TestServer server({.still = true});
    WsClient first(server.port());
    const v1::Welcome welcome = first.join("hall");
    EXPECT_EQ(welcome.room().room(), "hall");
    EXPECT_EQ(welcome.room().controller(), welcome.room().you());
    const Frame drawn = first.expectFrame();
    WsClient second(server.port());
    const v1::Welcome late = second.join("hall");
    EXPECT_EQ(late.session_id(), welcome.session_id());
    EXPECT_EQ(late.room().controller(), welcome.room().you());
    EXPECT_EQ(late.room().member_count(), 2U);
    const Frame kept = second.expectFrame();
    EXPECT_EQ(kept.jpeg, drawn.jpeg);
    EXPECT_EQ(kept.header.frame_id(), drawn.header.frame_id());
    EXPECT_EQ(server.device().submitted_count, 1U) << "drawn once";
    const uint64_t seq = first.send(setExposure(4));
    first.expectState(seq);
    const Frame brighter =
        first.expectFrame([&](const auto& header) { return header.applied_seq() == seq; });
    const Frame same = second.expectFrame();
    EXPECT_EQ(same.jpeg, brighter.jpeg);
    EXPECT_EQ(same.header.applied_seq(), 0U) << "no command of its own";
    EXPECT_EQ(server.device().live_views, 1);
}

TEST(Rooms, Watcher_IsRefusedClearly_FollowsTheState_AndCanBeHandedControl) {
    TestServer server({.still = true});
    WsClient first(server.port());
    const uint64_t controller = first.join("hall").room().you();
    WsClient second(server.port());
    const uint64_t watcher = second.join("hall").room().you();
    const uint64_t refused = second.send(setExposure(3));
    const v1::Error error = second.expectError();
    EXPECT_EQ(error.code(), v1::ERROR_CODE_CONTROL);
    EXPECT_EQ(error.ref_seq(), refused);
    EXPECT_NE(error.message().find("viewer " + std::to_string(controller)), std::string::npos)
        << error.message();
    first.expectState(first.send(setExposure(2)));
    EXPECT_DOUBLE_EQ(second.expect(ServerMessage::kState).state().state().exposure(), 2);

    second.send(requestControl());
    roomWith(first, [&](const auto& room) {
        return room.members_size() == 2 && room.members(1).asking();
    });
    first.send(giveControl(watcher));
    roomWith(second, [&](const auto& room) { return room.controller() == watcher; });
    EXPECT_DOUBLE_EQ(second.expectState(second.send(setExposure(5))).exposure(), 5);
    first.send(setExposure(6));
    EXPECT_EQ(first.expectError().code(), v1::ERROR_CODE_CONTROL);
    first.send(giveControl(controller));
    EXPECT_EQ(first.expectError().code(), v1::ERROR_CODE_CONTROL);
    second.send(giveControl(99));
    EXPECT_EQ(second.expectError().field(), "member_id");
    second.close();
    roomWith(first, [&](const auto& room) { return room.controller() == 0; });
    first.send(requestControl());
    roomWith(first, [&](const auto& room) { return room.controller() == controller; });
}

TEST(Rooms, BadName_IsRefusedWithTheRule) {
    TestServer server;
    WsClient client(server.port());
    client.hello("two words");
    const v1::Error error = client.expectError();
    EXPECT_EQ(error.code(), v1::ERROR_CODE_OUT_OF_RANGE);
    EXPECT_EQ(error.field(), "room");
    EXPECT_NE(error.message().find("1 to 64"), std::string::npos) << error.message();
}

// It takes nothing at all of pictures that no buffer holds; the room goes on at its pace, and the
// stuck one is let go.
TEST(Rooms, OneReadsNothing_OthersStreamAndItIsLetGo) {
    TestServer server({.size = {640, 360}});
    server.device().noisy = true;
    WsClient quick(server.port());
    quick.join("hall");
    const auto rate = [&quick](Seconds time) {
        const auto begin = Clock::now();
        int frames = 0;
        for (; Clock::now() - begin < time; ++frames) {
            quick.expectFrame();
        }
        return frames / time.count();
    };
    const double alone = rate(2s);
    WsClient stuck(server.port(), {.auto_ack = false, .receive_buffer_bytes = 4096});
    stuck.join("hall");
    EXPECT_GT(rate(2s), alone / 2);
    const auto begin = Clock::now();
    EXPECT_TRUE(eventually([&] {
        quick.expectFrame();
        return sampleOf(httpGet(server.adminPort(), "/metrics"), "froxel_viewers") == 1;
    }));
    EXPECT_LT(Clock::now() - begin, 15s);
    EXPECT_EQ(server.device().live_views, 1);
}

TEST(Rooms, CountsAsOneSession) {
    TestServer server({.sessions_max = 1});
    std::deque<WsClient> watchers;
    for (int i = 0; i < 5; ++i) {
        watchers.emplace_back(server.port(), ClientOptions{.target = "/ws?room=hall"});
        watchers.back().join("hall");
    }
    EXPECT_THROW(WsClient own(server.port()), boost::system::system_error);
    watchers.back().expectFrame();
}

TEST(Resume, LostConnection_ComesBackWithItsState) {
    TestServer server({.still = true, .resume_grace = 60s});
    std::string token;
    uint64_t session = 0;
    {
        WsClient client(server.port());
        const v1::Welcome welcome = client.join();
        token = welcome.resume_token();
        session = welcome.session_id();
        EXPECT_EQ(token.size(), 64U);
        EXPECT_EQ(welcome.resume_grace_ms(), 60'000U);
        EXPECT_FALSE(welcome.resumed());
        const uint64_t seq = client.send(setExposure(3));
        client.expectFrame([&](const auto& header) { return header.applied_seq() == seq; });
        client.abort();
    }
    const uint64_t drawn = server.device().submitted_count;
    WsClient back(server.port());
    const v1::Welcome again = back.join("", token);
    EXPECT_TRUE(again.resumed());
    EXPECT_EQ(again.session_id(), session);
    EXPECT_DOUBLE_EQ(again.state().exposure(), 3);
    EXPECT_DOUBLE_EQ(again.defaults().exposure(), 1);
    const Frame frame = back.expectFrame();
    EXPECT_EQ(frame.header.applied_seq(), 0U) << "a new connection has commands of its own";
    EXPECT_EQ(server.device().submitted_count, drawn) << "the kept picture, not a new one";
    EXPECT_DOUBLE_EQ(back.expectState(back.send(setExposure(4))).exposure(), 4);
}

TEST(Resume, NewerConnection_Wins_TheOlderIsClosedWith4009) {
    TestServer server({.resume_grace = 60s});
    WsClient older(server.port());
    const v1::Welcome welcome = older.join();
    WsClient newer(server.port());
    EXPECT_TRUE(newer.join("", welcome.resume_token()).resumed());
    EXPECT_EQ(older.expectClosed().code, 4009);
    newer.expectFrame();
    newer.expectFrame();
    EXPECT_EQ(server.device().live_views, 1);
}

TEST(Resume, GraceIsOver_IsANewSessionAndSaysSo) {
    TestServer server({.resume_grace = 50ms});
    WsClient client(server.port());
    const v1::Welcome welcome = client.join();
    client.expectFrame();
    client.abort();
    EXPECT_TRUE(eventually([&] { return server.device().live_views == 0; }));
    WsClient back(server.port());
    const v1::Welcome again = back.join("", welcome.resume_token());
    EXPECT_FALSE(again.resumed());
    EXPECT_NE(again.resume_token(), welcome.resume_token());
    back.expectFrame();
}

TEST(Resume, SaidGoodbye_IsNotWaitedFor) {
    TestServer server({.sessions_max = 1, .resume_grace = 60s});
    WsClient client(server.port());
    client.join();
    client.expectFrame();
    client.close();
    EXPECT_TRUE(eventually([&] { return server.device().live_views == 0; }));
    WsClient next(server.port());
    next.join();
}

TEST(Resume, DuringDrain_NothingIsKept_AndTheServerEndsAtOnce) {
    TestServer server({.resume_grace = 60s});
    WsClient away(server.port());
    away.join();
    away.expectFrame();
    away.abort();
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_TRUE(server.run().drain(20s));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 10s);
}

TEST(Resume, RoomMemberWithControl_GetsBoth) {
    TestServer server({.resume_grace = 60s});
    WsClient watcher(server.port());
    v1::Welcome welcome;
    {
        WsClient client(server.port());
        welcome = client.join("hall");
        watcher.join("hall");
        client.expectFrame();
        client.abort();
    }
    roomWith(watcher, [&](const auto& room) {
        return room.controller() == welcome.room().you() && room.members(0).away();
    });
    watcher.expectFrame();
    WsClient back(server.port());
    const v1::Welcome again = back.join("hall", welcome.resume_token());
    EXPECT_TRUE(again.resumed());
    EXPECT_EQ(again.room().you(), welcome.room().you());
    EXPECT_EQ(again.room().controller(), again.room().you());
    back.expectState(back.send(setExposure(3)));
}

TEST(Pause, HiddenPage_NothingIsDrawn_ThenTheNewestPicture) {
    TestServer server;
    WsClient client(server.port());
    client.join();
    client.expectFrame();
    client.send(pause(true));
    ClientMessage ping;
    ping.mutable_ping();
    client.send(ping);
    client.expect(ServerMessage::kPong);
    while (!client.quietFor(200ms)) {
        // what was on its way
    }
    const uint64_t drawn = server.device().submitted_count;
    const uint64_t seq = client.send(setExposure(3));
    client.expectState(seq);
    EXPECT_TRUE(client.quietFor(200ms));
    EXPECT_EQ(server.device().submitted_count, drawn);
    client.send(pause(false));
    client.expectFrame([&](const auto& header) { return header.applied_seq() == seq; });
    client.expectFrame();
}

// All at once and most of them too many: each hears a clear word, those inside see no gap.
TEST(Storm, ManyConnectAtOnce_SomeGetIn_TheRestAreToldWhy_NobodyCrashes) {
    TestServer server({.sessions_max = 4, .connections_max = 128, .resume_grace = 200ms});
    WsClient steady(server.port());
    steady.join();
    std::atomic<int> welcomed = 0;
    std::atomic<int> refused = 0;
    std::atomic<int> cut = 0;
    std::vector<std::jthread> crowd;
    for (int thread = 0; thread < 8; ++thread) {
        crowd.emplace_back([&] {
            for (int round = 0; round < 25; ++round) {
                try {
                    WsClient client(server.port());
                    client.hello();
                    const auto answer = client.expectAnswer();
                    ++(answer.has_welcome() ? welcomed : refused);
                    if (round % 2 == 0) {
                        client.abort();
                    } else {
                        client.close();
                    }
                } catch (const boost::system::system_error& error) {
                    const bool told =
                        error.code() == boost::beast::websocket::error::upgrade_declined;
                    ++(told ? refused : cut); // cut: over the cap on connections
                } catch (const std::exception&) {
                    ++cut;
                }
            }
        });
    }
    const auto begin = std::chrono::steady_clock::now();
    int frames = 0;
    while (welcomed + refused + cut < 200 && std::chrono::steady_clock::now() - begin < 60s) {
        steady.expectFrame();
        ++frames;
    }
    crowd.clear();
    EXPECT_EQ(welcomed + refused + cut, 200);
    EXPECT_GT(welcomed, 0);
    EXPECT_GT(refused, 0);
    EXPECT_GT(frames, 0);
    EXPECT_TRUE(eventually([&] { return server.device().live_views == 1; }));
    steady.expectFrame();
    server.end();
    EXPECT_EQ(server.device().live_leases, 0);
}

// Everyone comes back at the same time, as after a lost switch: each into its own session.
TEST(Storm, ManyResumeAtOnce_EachGetsItsOwn) {
    TestServer server({.sessions_max = 16, .still = true, .resume_grace = 60s});
    std::vector<v1::Welcome> welcomes;
    {
        std::deque<WsClient> clients;
        for (int i = 0; i < 16; ++i) {
            clients.emplace_back(server.port());
            welcomes.push_back(clients.back().join());
            clients.back().expectState(clients.back().send(setExposure(1 + i)));
        }
        for (WsClient& client : clients) {
            client.abort();
        }
    }
    std::vector<std::jthread> crowd;
    std::atomic<int> right = 0;
    for (int i = 0; i < 16; ++i) {
        crowd.emplace_back([&, i] {
            const std::string& token = welcomes[static_cast<size_t>(i)].resume_token();
            WsClient client(server.port(), {.target = "/ws?resume=" + token.substr(0, 16)});
            const auto again = client.join("", token);
            right += again.resumed() && again.state().exposure() == 1 + i &&
                     again.session_id() == welcomes[static_cast<size_t>(i)].session_id();
            client.expectFrame();
        });
    }
    crowd.clear();
    EXPECT_EQ(right, 16);
}

// Sessions whose pictures take the whole device: one more is refused with the figures; a room and
// an idle session stay open.
TEST(AdmissionByCost, DeviceIsBusy_RefusesClearly_ExistingOnesKeepTheirRate) {
    TestServer server({.min_rate_hz = 50});
    server.device().frame_time = 30ms;
    WsClient first(server.port());
    first.join("hall");
    const auto twenty = [&first] {
        const auto begin = Clock::now();
        for (int i = 0; i < 20; ++i) {
            first.expectFrame();
        }
        return Seconds(Clock::now() - begin);
    };
    const Seconds alone = twenty();
    for (int i = 0; i < 10; ++i) {
        EXPECT_THROW(WsClient refused(server.port()), boost::system::system_error);
    }
    EXPECT_LT(twenty(), 2 * alone);
    const std::string told = httpGet(server.port(), "/ws");
    EXPECT_EQ(statusOf(told), 503);
    EXPECT_NE(told.find("Froxel-Close-Code: 4030"), std::string::npos) << told;
    EXPECT_NE(told.find("the server cannot draw for more viewers now"), std::string::npos);
    for (const char* target : {"/ws?room=hall", "/rooms/ws?room=hall"}) {
        WsClient watcher(server.port(), {.target = target});
        watcher.join("hall");
        watcher.expectFrame();
    }
}

} // namespace
} // namespace froxel::test

// Places, as far as sockets take part in them: who is let in before and after the upgrade.
#include "integration/http_exchange.h"
#include "integration/raw_web_socket.h"
#include "integration/test_server.h"
#include "integration/ws_client.h"

#include <gtest/gtest.h>

#include <deque>

namespace froxel::test {
namespace {

using namespace std::chrono_literals;

constexpr int kHostile = 40;
constexpr int kHonest = 37;

bool comesIn(std::deque<WsClient>& guests, uint16_t port, const ClientOptions& options) {
    try {
        guests.emplace_back(port, options).join();
        return true;
    } catch (const boost::system::system_error&) {
        return false; // before the upgrade
    }
}

// And has been heard when it returns.
void pause(WsClient& client) {
    v1::ClientMessage message;
    message.mutable_pause()->set_paused(true);
    client.send(message);
    message.mutable_ping();
    client.send(message);
    client.expect(v1::ServerMessage::kPong);
}

// As one process on one host would.
int pausing(std::deque<WsClient>& guests, uint16_t port, const std::string& address) {
    int in = 0;
    for (int i = 0; i < kHostile; ++i) {
        if (comesIn(guests, port, {.forwarded_for = address})) {
            pause(guests.back());
            ++in;
        }
    }
    return in;
}

TEST(Places, OneAddressConnectsAndPauses_TakesItsShare_AndAllOthersComeIn) {
    TestServer server({.sessions_max = 45,
                       .trusted_proxies = {"127.0.0.0/8"},
                       .rules = {.sessions_per_address = 8}});
    std::deque<WsClient> hostile;
    EXPECT_EQ(pausing(hostile, server.port(), "198.51.100.66"), 8);
    std::deque<WsClient> honest;
    for (int i = 0; i < kHonest; ++i) {
        const std::string address = "192.0.2." + std::to_string(i + 1);
        EXPECT_TRUE(comesIn(honest, server.port(), {.forwarded_for = address})) << i;
    }
    honest.back().expectFrame();
}

TEST(Places, ManyConnectAndPauseFromOneProxy_GiveWayOneByOne) {
    TestServer server({.sessions_max = kHostile, .rules = {.rest = {.paused = 0s}}});
    std::deque<WsClient> hostile;
    EXPECT_EQ(pausing(hostile, server.port(), ""), kHostile);
    std::deque<WsClient> honest;
    for (int i = 0; i < kHonest; ++i) {
        EXPECT_TRUE(comesIn(honest, server.port(), {})) << i;
    }
    EXPECT_EQ(hostile.front().expectClosed().code, 4011);
    honest.back().expectFrame();
}

TEST(Places, Full_IsToldBeforeTheUpgrade_ButNotToWhoComesBackOrJoinsARoom) {
    TestServer server({.sessions_max = 2, .resume_grace = 60s});
    WsClient first(server.port());
    const std::string token = first.join().resume_token();
    WsClient hall(server.port());
    hall.join("hall");
    const std::string answer = httpExchange(server.port(), upgradeRequest());
    EXPECT_EQ(statusOf(answer), 503);
    EXPECT_NE(answer.find("Retry-After: 5\r\n"), std::string::npos) << answer;
    EXPECT_EQ(bodyOf(answer), "all 2 sessions of this server are in use; try again later\n");
    EXPECT_EQ(bodyOf(httpGet(server.port(), "/ws")), bodyOf(answer)) << "a page asks like this";

    first.abort();
    WsClient back(server.port(), {.target = "/ws?resume=" + token.substr(0, 16)});
    EXPECT_TRUE(back.join("", token).resumed());
    WsClient watcher(server.port(), {.target = "/ws?room=hall"});
    watcher.join("hall");
    watcher.expectFrame();
}

TEST(Places, OneAddressConnects_AndSaysNothing_OthersAreServed) {
    TestServer server({.connections_max = 8});
    boost::asio::io_context io;
    std::deque<boost::asio::ip::tcp::socket> silent;
    for (int i = 0; i < 20; ++i) {
        auto& socket = silent.emplace_back(io);
        socket.open(boost::asio::ip::tcp::v4());
        socket.bind({boost::asio::ip::make_address("127.0.0.66"), 0});
        socket.connect({boost::asio::ip::address_v4::loopback(), server.port()});
    }
    WsClient honest(server.port());
    honest.join();
    honest.expectFrame();
}

} // namespace
} // namespace froxel::test

// Connections that misbehave, and what the others notice of it.
#include "integration/eventually.h"
#include "integration/http_exchange.h"
#include "integration/raw_web_socket.h"
#include "integration/test_server.h"
#include "integration/ws_client.h"

#include <boost/system/system_error.hpp>
#include <gtest/gtest.h>

#include <fstream>
#include <future>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace froxel::test {
namespace {

using namespace std::chrono_literals;
using protocol::WireFormat;
using v1::ClientMessage;
using v1::ServerMessage;

ClientMessage setSize(uint32_t width, uint32_t height) {
    ClientMessage message;
    message.mutable_set_size()->set_width(width);
    message.mutable_set_size()->set_height(height);
    return message;
}

ClientMessage setExposure(double exposure) {
    ClientMessage message;
    message.mutable_set_exposure()->set_exposure(exposure);
    return message;
}

bool upgradeIsRefused(uint16_t port, const ClientOptions& options) {
    try {
        WsClient client(port, options);
        return false;
    } catch (const boost::system::system_error&) {
        return true;
    }
}

std::string originOf(uint16_t port) {
    return "http://127.0.0.1:" + std::to_string(port);
}

TEST(Upgrade, Origins_OwnAndListedOnly_AreAccepted) {
    TestServer server({.allowed_origins = {"https://gallery.example"}});
    const std::string own = originOf(server.port());
    EXPECT_FALSE(upgradeIsRefused(server.port(), {.origin = own}));
    EXPECT_FALSE(upgradeIsRefused(server.port(), {.origin = ""}));
    EXPECT_FALSE(upgradeIsRefused(server.port(), {.origin = "https://gallery.example"}));
    for (const std::string& foreign :
         {std::string("http://evil.example"), std::string("null"), own + ".evil.example",
          "http://evil" + own.substr(7), std::string("http://127.0.0.1"), "file://" + own}) {
        EXPECT_TRUE(upgradeIsRefused(server.port(), {.origin = foreign})) << foreign;
    }
}

TEST(Upgrade, Subprotocol_MustBeOffered) {
    TestServer server;
    EXPECT_TRUE(upgradeIsRefused(server.port(), {.subprotocol = "chat"}));
    EXPECT_TRUE(upgradeIsRefused(server.port(), {.subprotocol = ""}));
    EXPECT_FALSE(upgradeIsRefused(server.port(), {.subprotocol = "chat, froxel.v1"}));
}

TEST(Messages, OverTheCap_CloseWithTooBig) {
    TestServer server;
    WsClient client(server.port());
    client.join();
    client.sendRaw(std::string(64 * 1024 + 1, 'x'), WireFormat::kBinary);
    EXPECT_EQ(client.expectClosed().code, 1009);
}

// Pictures that are on their way out must not cut off the words.
TEST(Messages, OverTheCapWhilePicturesFlow_CloseWithTooBig) {
    TestServer server({.size = {640, 480}});
    for (int i = 0; i < 20; ++i) {
        WsClient client(server.port());
        client.join();
        client.expectFrame();
        client.sendRaw(std::string(size_t{200} * 1024, 'x'), WireFormat::kBinary);
        const Closed closed = client.expectClosed();
        ASSERT_EQ(closed.code, 1009) << i << " " << closed.reason;
    }
}

TEST(Messages, HelloOverItsCap_ClosesWithTooBig) {
    TestServer server;
    WsClient client(server.port());
    client.sendRaw(std::string(5000, 'x'), WireFormat::kBinary);
    EXPECT_EQ(client.expectClosed().code, 1009);
}

TEST(Messages, NoHello_ClosesWithPolicy) {
    TestServer server;
    WsClient client(server.port());
    EXPECT_EQ(client.expectClosed().code, 1008);
}

TEST(SessionLimit, Reached_RefusesClearlyUntilOneLeaves) {
    TestServer server({.sessions_max = 2});
    WsClient first(server.port());
    WsClient second(server.port());
    first.join();
    second.join();
    EXPECT_TRUE(upgradeIsRefused(server.port(), {}));
    first.expectFrame();
    second.close();
    EXPECT_TRUE(eventually([&] { return !upgradeIsRefused(server.port(), {}); }));
    WsClient fourth(server.port());
    fourth.join();
}

TEST(ConnectionLimit, Reached_TellsNewOnesToComeBackAndKeepsTheOld) {
    TestServer server({.connections_max = 2});
    WsClient first(server.port());
    first.join();
    WsClient second(server.port());
    EXPECT_TRUE(upgradeIsRefused(server.port(), {}));
    const std::string refused =
        httpExchange(server.port(), "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(statusOf(refused), 503);
    EXPECT_NE(refused.find("Retry-After: "), std::string::npos) << refused;
    first.expectFrame();
    second.close();
    EXPECT_TRUE(eventually([&] { return !upgradeIsRefused(server.port(), {}); }));
}

double residentMb() {
    std::ifstream statm("/proc/self/statm");
    double total = 0;
    double resident = 0;
    statm >> total >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

TEST(ConnectionLimit, TwoThousandSayNothing_AViewerIsServedAndMemoryBounded) {
    constexpr rlim_t kNeeded = 4500; // both ends of each are in this process
    rlimit limit{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &limit), 0);
    if (limit.rlim_max < kNeeded) {
        GTEST_SKIP() << "no more than " << limit.rlim_max << " descriptors are allowed";
    }
    limit.rlim_cur = limit.rlim_max;
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &limit), 0);

    TestServer server({.connections_max = 4096});
    const double before_mb = residentMb();
    boost::asio::io_context io;
    std::vector<boost::asio::ip::tcp::socket> silent;
    for (int i = 0; i < 2000; ++i) {
        silent.emplace_back(io).connect({boost::asio::ip::address_v4::loopback(), server.port()});
    }
    WsClient viewer(server.port());
    viewer.join();
    viewer.expectFrame();
    EXPECT_LT(residentMb() - before_mb, 60);
}

TEST(Credit, ClientNeverAcks_Pauses) {
    TestServer server;
    WsClient client(server.port(), {.auto_ack = false});
    client.join();
    client.expectFrame();
    const Frame second = client.expectFrame();
    EXPECT_TRUE(client.quietFor(500ms));
    const uint64_t drawn = server.device().submitted_count;
    EXPECT_TRUE(client.quietFor(200ms));
    EXPECT_EQ(server.device().submitted_count, drawn) << "the server draws for nobody";
    EXPECT_LE(drawn, 6U);
    client.ack(second.header.frame_id());
    client.expectFrame();
}

// It sends commands, which keeps every timeout of the WebSocket quiet, but takes nothing: the write
// gets stuck and its deadline ends the connection. The other viewer notices nothing.
TEST(SlowReader, NeverReads_IsDroppedAndOthersStream) {
    TestServer server({.sessions_max = 2});
    WsClient slow(server.port(), {.auto_ack = false, .receive_buffer_bytes = 4096});
    slow.join();
    slow.send(setSize(4096, 4096));
    WsClient quick(server.port());
    quick.join();

    std::promise<void> done;
    std::thread flood([&, finished = done.get_future()] {
        try {
            for (double i = 1; finished.wait_for(5ms) == std::future_status::timeout; ++i) {
                slow.send(setExposure(i));
            }
        } catch (const boost::system::system_error&) {
            // dropped by the server, as it should be
        }
    });
    const auto begin = std::chrono::steady_clock::now();
    uint64_t frames = 0;
    const bool dropped = eventually([&] {
        quick.expectFrame();
        ++frames;
        return server.device().live_views == 1;
    });
    const Seconds took = std::chrono::steady_clock::now() - begin;
    done.set_value();
    flood.join();
    EXPECT_TRUE(dropped);
    EXPECT_GT(took, 4s);
    EXPECT_GT(static_cast<double>(frames) / took.count(), 5.0);
    WsClient next(server.port());
    next.join();
}

TEST(SlowReader, ReadsLate_GetsTheNewestPicture) {
    TestServer server({.still = true});
    WsClient client(server.port(), {.auto_ack = false});
    client.join();
    uint64_t seq = 0;
    for (uint32_t i = 0; i < 100; ++i) {
        seq = client.send(setSize(32 + i, 32));
    }
    Frame frame = client.expectFrame();
    int seen = 1;
    while (frame.header.applied_seq() < seq) {
        client.ack(frame.header.frame_id());
        frame = client.expectFrame();
        ++seen;
    }
    EXPECT_EQ(frame.header.width(), 131U);
    EXPECT_LT(seen, 20) << "pictures in between are skipped, not queued";
}

TEST(AbruptClose, MidFrame_FreesTheSessionAndOthersStream) {
    TestServer server({.sessions_max = 3});
    WsClient steady(server.port());
    steady.join();
    for (int i = 0; i < 30; ++i) {
        WsClient victim(server.port());
        victim.join();
        victim.send(setSize(1024, 1024));
        if (i % 2 == 0) {
            victim.expectFrame();
        }
        victim.abort();
        steady.expectFrame();
        ASSERT_TRUE(eventually([&] { return server.device().live_views <= 2; }));
    }
    EXPECT_TRUE(eventually([&] { return server.device().live_views == 1; }));
    steady.expectFrame();
    server.end();
    EXPECT_EQ(server.device().live_leases, 0);
}

TEST(AbruptClose, DuringTheHandshake_ServerLives) {
    TestServer server;
    boost::asio::io_context io;
    for (int i = 0; i < 50; ++i) {
        boost::asio::ip::tcp::socket socket(io);
        socket.connect({boost::asio::ip::address_v4::loopback(), server.port()});
        boost::asio::write(socket, boost::asio::buffer("GET /ws HTTP/1.1\r\nHost: x\r\n", 27));
        socket.set_option(boost::asio::socket_base::linger(true, 0));
        socket.close();
    }
    WsClient client(server.port());
    client.join();
}

TEST(Loading, SceneIsNotThere_SaysSoAndKeepsCommands) {
    TestServer server({.open_at_once = false});
    WsClient client(server.port());
    client.hello();
    const v1::Loading loading = client.expect(ServerMessage::kLoading).loading();
    EXPECT_FALSE(loading.stage().empty());
    const uint64_t seq = client.send(setSize(200, 100));
    ClientMessage ping;
    ping.mutable_ping();
    client.send(ping);
    client.expect(ServerMessage::kPong);
    server.open();
    client.expect(ServerMessage::kWelcome);
    EXPECT_EQ(client.expectState(seq).width(), 200U);
    client.expectFrame([](const auto& header) { return header.width() == 200; });
}

TEST(DeviceLost, WhileStreaming_IsToldAndClosesWithItsCode) {
    TestServer server;
    WsClient client(server.port());
    client.join();
    client.expectFrame();
    server.device().lost = true;
    EXPECT_EQ(client.expectError().code(), v1::ERROR_CODE_DEVICE);
    EXPECT_EQ(client.expectClosed().code, 4050);
}

TEST(Drain, ViewersConnected_AreToldAndGoOnUntilTheDeadline) {
    TestServer server;
    WsClient client(server.port());
    client.join();
    client.expectFrame();
    auto drained = std::async(std::launch::async, [&] { return server.run().drain(1s); });
    EXPECT_EQ(client.expect(ServerMessage::kDraining).draining().deadline_ms(), 800U);
    client.expectFrame();
    const std::string refused = httpExchange(server.port(), upgradeRequest());
    EXPECT_EQ(statusOf(refused), 503);
    EXPECT_NE(refused.find("Retry-After: "), std::string::npos) << refused;
    EXPECT_EQ(statusOf(httpGet(server.adminPort(), "/readyz")), 503);
    EXPECT_EQ(client.expectClosed().code, 4010);
    EXPECT_TRUE(drained.get());
    EXPECT_TRUE(upgradeIsRefused(server.port(), {}));
}

TEST(Drain, LastViewerLeaves_EndsAtOnce) {
    TestServer server;
    WsClient client(server.port());
    client.join();
    auto drained = std::async(std::launch::async, [&] { return server.run().drain(60s); });
    client.expect(ServerMessage::kDraining);
    client.close();
    ASSERT_EQ(drained.wait_for(10s), std::future_status::ready);
    EXPECT_TRUE(drained.get());
}

TEST(Drain, NoTimeAtAll_ViewersAreToldNevertheless) {
    TestServer server;
    WsClient client(server.port());
    client.join();
    auto drained = std::async(std::launch::async, [&] { return server.run().drain(0ms); });
    EXPECT_EQ(client.expectClosed().code, 4010);
    EXPECT_TRUE(drained.get());
}

TEST(Drain, ViewerNeverAnswers_EndsAtTheDeadline) {
    TestServer server;
    WsClient client(server.port());
    client.join();
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_FALSE(server.run().drain(300ms));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, 3s);
}

} // namespace
} // namespace froxel::test

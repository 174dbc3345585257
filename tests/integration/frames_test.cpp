// WebSocket frames that RFC 6455 forbids, and ones that it allows and nobody sends; handshakes that
// stop half way.
#include "integration/eventually.h"
#include "integration/raw_web_socket.h"
#include "integration/test_server.h"
#include "integration/ws_client.h"
#include "protocol/limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

namespace froxel::test {
namespace {

using namespace std::chrono_literals;
using Raw = RawWebSocket;

std::string helloBytes() {
    v1::ClientMessage message;
    message.set_seq(1);
    message.mutable_hello()->set_protocol_major(protocol::kMajor);
    return message.SerializeAsString();
}

double residentBytes() {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);) {
        if (line.rfind("VmRSS:", 0) == 0) {
            return std::stod(line.substr(6)) * 1024;
        }
    }
    return 0;
}

ptrdiff_t openDescriptors() {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
}

double closesOf(const TestServer& server, const std::string& code) {
    return sampleOf(httpGet(server.adminPort(), "/metrics"),
                    "froxel_websocket_closes_total{code=\"" + code + "\"}");
}

struct BadFrames {
    const char* name;
    std::string bytes;
    uint16_t close_code;
};

TEST(Frames, Forbidden_CloseWithTheCodeOfTheRfcAndTheServerLives) {
    const std::vector<BadFrames> table = {
        {"unmasked", Raw::head(Raw::kBinary, 0, 2) + "hi", 1002},
        {"reserved bit 1", Raw::frame(0xC2, "hi"), 1002},
        {"reserved bit 2", Raw::frame(0xA2, "hi"), 1002},
        {"reserved bit 3", Raw::frame(0x92, "hi"), 1002},
        {"reserved data opcode", Raw::frame(0x83, "hi"), 1002},
        {"reserved control opcode", Raw::frame(0x8B, "hi"), 1002},
        {"ping in fragments", Raw::frame(0x09, "hi"), 1002},
        {"ping of 126 bytes", Raw::frame(Raw::kPing, std::string(126, 'x')), 1002},
        {"continuation of nothing", Raw::frame(0x80, "hi"), 1002},
        {"a message within a message", Raw::frame(0x02, "a") + Raw::frame(Raw::kBinary, "b"), 1002},
        {"text that is not UTF-8", Raw::frame(Raw::kText, "\xff\xfe"), 1007},
        {"a surrogate in UTF-8", Raw::frame(Raw::kText, "\xed\xa0\x80"), 1007},
        {"close code 1005", Raw::frame(Raw::kClose, "\x03\xed"), 1002},
        {"close code 999", Raw::frame(Raw::kClose, "\x03\xe7"), 1002},
        {"close of one byte", Raw::frame(Raw::kClose, "x"), 1002},
        {"close reason not UTF-8", Raw::frame(Raw::kClose, "\x03\xe8\xff"), 1002},
        {"length of 2^63", Raw::head(Raw::kBinary, 0x80, uint64_t{1} << 63U) + "mask", 1009},
        {"length of 2^63 - 1", Raw::head(Raw::kBinary, 0x80, (uint64_t{1} << 63U) - 1) + "mask",
         1009},
        {"a long form for a short length", std::string("\x82\xfe\x00\x01mask!", 9), 1002},
    };
    TestServer server;
    const double before_bytes = residentBytes();
    for (const BadFrames& bad : table) {
        Raw socket(server.port());
        socket.send(bad.bytes);
        EXPECT_EQ(socket.closeCode(), bad.close_code) << bad.name;
    }
    EXPECT_LT(residentBytes() - before_bytes, 32e6) << "a length alone must not allocate";
    WsClient(server.port()).join();
    EXPECT_TRUE(eventually([&] { return closesOf(server, "1002") >= 14; }));
    EXPECT_EQ(closesOf(server, "1009"), 2);
}

TEST(Frames, HelloInFragmentsOfOneByteAmongPings_IsUnderstood) {
    TestServer server({.still = true});
    Raw socket(server.port());
    const std::string hello = helloBytes();
    std::string bytes;
    for (size_t i = 0; i < hello.size(); ++i) {
        const bool last = i + 1 == hello.size();
        const uint8_t opcode = i == 0 ? 0x02 : 0x00;
        bytes += Raw::frame(static_cast<uint8_t>(opcode | (last ? 0x80U : 0U)), hello.substr(i, 1));
        bytes += Raw::frame(Raw::kPing, std::to_string(i));
    }
    socket.send(bytes);
    size_t pongs = 0;
    bool welcomed = false;
    while (!welcomed || pongs == 0) {
        const auto got = socket.read();
        ASSERT_TRUE(got) << "closed after " << pongs << " pongs";
        pongs += got->first == Raw::kPong ? 1U : 0U;
        v1::ServerMessage message;
        welcomed =
            welcomed || (got->first == Raw::kBinary && got->payload[1] == 2 &&
                         message.ParseFromString(got->payload.substr(4)) && message.has_welcome());
    }
}

TEST(Frames, MessageWithoutEnd_ClosesWithTooBigInBoundedMemory) {
    TestServer server;
    Raw socket(server.port());
    const double before_bytes = residentBytes();
    const std::string piece = Raw::frame(0x00, std::string(1000, 'x'));
    std::string pieces = Raw::frame(0x02, "x");
    for (int i = 0; i < 100; ++i) {
        pieces += piece;
    }
    socket.send(pieces); // the server may have closed before all was sent
    EXPECT_EQ(socket.closeCode(), 1009);
    EXPECT_LT(residentBytes() - before_bytes, 32e6);
}

// A proxy that drops idle connections sees a sign of life: Beast pings at half of 20 s. A peer that
// is gone without a word does not answer.
TEST(Frames, NothingMoves_ThePeerIsPingedAndLetGoUnlessItAnswers) {
    TestServer server({.still = true, .resume_grace = 300ms});
    Raw socket(server.port());
    socket.send(Raw::frame(Raw::kBinary, helloBytes()));
    const auto begin = Clock::now();
    auto got = socket.read();
    while (got && got->first != Raw::kPing) {
        got = socket.read();
    }
    ASSERT_TRUE(got);
    EXPECT_LT(Clock::now() - begin, 20s);
    EXPECT_EQ(server.device().live_views, 1);
    EXPECT_TRUE(socket.ends());
    EXPECT_LT(Clock::now() - begin, 25s);
    EXPECT_TRUE(eventually([&] { return server.device().live_views == 0; }));
}

TEST(Handshakes, EndedHalfWay_LeaveNoDescriptorBehind) {
    TestServer server;
    WsClient(server.port()).join(); // what is opened lazily is open
    ASSERT_TRUE(eventually([&] { return server.device().live_views == 0; }));
    const auto before = openDescriptors();
    for (int i = 0; i < 30; ++i) {
        Raw half(server.port(), false);
        half.send("GET /ws HTTP/1.1\r\nHost: lo");
        half.endSending();
        EXPECT_TRUE(half.ends());
    }
    EXPECT_TRUE(eventually([&] { return openDescriptors() <= before; }))
        << before << " before, " << openDescriptors() << " now";
}

TEST(Handshakes, CloseIsNeverAnswered_TheServerLetsGo) {
    TestServer server;
    v1::ClientMessage message;
    message.set_seq(1);
    message.mutable_hello()->set_protocol_major(99);
    Raw silent(server.port());
    const auto begin = Clock::now();
    silent.send(Raw::frame(Raw::kBinary, message.SerializeAsString()));
    EXPECT_EQ(silent.closeCode(), 4001);
    EXPECT_TRUE(silent.ends()); // and it says nothing
    EXPECT_LT(Clock::now() - begin, 8s);
    EXPECT_TRUE(eventually([&] { return closesOf(server, "4001") == 1; }));
}

// What bounds a connection's queue is the kernel's affair too. Read back from the accepted socket,
// which is in this process.
TEST(Sockets, OfViewers_SendAtOnceHoldLittleUnsentAndGiveUpOnTheDead) {
    TestServer server({.still = true});
    WsClient client(server.port());
    client.join();
    int accepted = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        const int descriptor = std::stoi(entry.path().filename());
        sockaddr_in here{};
        sockaddr_in there{};
        socklen_t size = sizeof here;
        if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&here), &size) != 0 ||
            here.sin_family != AF_INET || ntohs(here.sin_port) != server.port() ||
            getpeername(descriptor, reinterpret_cast<sockaddr*>(&there), &(size = sizeof there)) !=
                0) {
            continue;
        }
        const auto option = [descriptor](int name) {
            int value = 0;
            socklen_t length = sizeof value;
            EXPECT_EQ(getsockopt(descriptor, IPPROTO_TCP, name, &value, &length), 0);
            return value;
        };
        ++accepted;
        EXPECT_NE(option(TCP_NODELAY), 0);
        EXPECT_EQ(option(TCP_NOTSENT_LOWAT), 128 * 1024);
        EXPECT_EQ(option(TCP_USER_TIMEOUT), 10'000);
    }
    EXPECT_EQ(accepted, 1);
}

// Nagle's algorithm or a delayed acknowledgement would show as 40 ms.
TEST(Latency, SixtyKilobytes_AreAnsweredWithoutWaitingForTheKernel) {
    TestServer server({.still = true});
    WsClient client(server.port());
    client.join();
    std::vector<Seconds> trips;
    for (int i = 0; i < 60; ++i) {
        v1::ClientMessage ping;
        ping.mutable_ping();
        ping.GetReflection()->MutableUnknownFields(&ping)->AddLengthDelimited(
            900, std::string(static_cast<size_t>(1000 * (i + 1)), 'x'));
        const auto begin = Clock::now();
        client.send(ping);
        client.expect(v1::ServerMessage::kPong);
        trips.push_back(Clock::now() - begin);
    }
    std::nth_element(trips.begin(), trips.begin() + 30, trips.end());
    EXPECT_LT(trips[30], 20ms) << "median";
}

} // namespace
} // namespace froxel::test

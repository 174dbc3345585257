// What a server holds on to, and what it does when there is no more of it: the real binary.
#include "integration/eventually.h"
#include "integration/http_exchange.h"
#include "integration/raw_web_socket.h"
#include "integration/server_process.h"
#include "integration/ws_client.h"
#include "protocol/limits.h"

#include <gtest/gtest.h>

#include <csignal>
#include <deque>
#include <fstream>
#include <sstream>
#include <sys/resource.h>
#include <unistd.h>

namespace froxel::test {
namespace {

using namespace std::chrono_literals;

const std::vector<std::string> kSmall = {"--size", "160x90", "--lights", "50"};

std::string metricsOf(uint16_t admin_port) {
    return bodyOf(httpGet(admin_port, "/metrics"));
}

// How often an event happened: lines, and those that the log left out.
double timesOf(const std::string& event, const std::string& log) {
    double times = 0;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        const size_t left_out = line.find("kind=" + event + " left_out=");
        if (line.find("event=" + event + " ") != std::string::npos) {
            ++times;
        } else if (left_out != std::string::npos) {
            times += std::strtod(line.c_str() + line.rfind('=') + 1, nullptr);
        }
    }
    return times;
}

uint64_t setRenderer(WsClient& client, v1::Renderer renderer) {
    v1::ClientMessage message;
    message.mutable_set_renderer()->set_renderer(renderer);
    return client.send(message);
}

// The listener backs off, those who are there go on, and it accepts again when there is room.
TEST(Descriptors, UsedUp_ViewersStreamOnAndLaterOnesGetIn) {
    ServerProcess server(kSmall);
    const uint16_t port = server.port().value();
    const uint16_t admin = server.adminPort().value();
    WsClient viewer(port);
    viewer.join();
    viewer.expectFrame();
    const double open = sampleOf(metricsOf(admin), "process_open_fds");
    ASSERT_GT(open, 10);
    const auto limit = static_cast<rlim_t>(open + 4);
    const rlimit tight{limit, limit};
    ASSERT_EQ(prlimit(server.pid(), RLIMIT_NOFILE, &tight, nullptr), 0);

    const auto begin = std::chrono::steady_clock::now();
    std::deque<RawWebSocket> crowd; // the kernel takes them; the server cannot
    for (int i = 0; i < 20; ++i) {
        crowd.emplace_back(port, false);
    }
    for (int i = 0; i < 60; ++i) {
        viewer.expectFrame();
    }
    crowd.clear();
    EXPECT_TRUE(eventually(
        [&] {
            try {
                WsClient late(port);
                late.join();
                return true;
            } catch (const std::exception&) {
                return false;
            }
        },
        30s));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    viewer.expectFrame();
    server.signal(SIGTERM);
    const auto end = server.wait(20s);
    EXPECT_EQ(end.exit_code, 0);
    const double pauses = timesOf("accepting_pauses", end.errors);
    EXPECT_GT(pauses, 0) << end.errors;
    EXPECT_LE(pauses, took.count() / 0.1 + 1) << "it backs off for 0.1 s instead of spinning";
}

// Of the process, bytes.
rlim_t addressSpaceOf(pid_t pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/statm");
    rlim_t pages = 0;
    file >> pages;
    return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

// A CPU device's memory is the host's: allocating a large picture's targets fails for real.
TEST(Memory, UsedUp_TheLargePictureIsRefusedAndTheOthersGoOn) {
    // On a busy machine the picture would take too long and be drawn smaller.
    ServerProcess server(
        {"--size", "160x90", "--lights", "50", "--session-memory", "4096", "--frame-limit", "60"});
    const uint16_t port = server.port().value();
    WsClient viewer(port);
    viewer.join();
    viewer.expectFrame();
    WsClient greedy(port);
    greedy.join();
    greedy.expectFrame();
    constexpr rlim_t kLeft = 64U << 20U;
    const rlim_t limit = addressSpaceOf(server.pid()) + kLeft;
    const rlimit tight{limit, limit};
    ASSERT_EQ(prlimit(server.pid(), RLIMIT_AS, &tight, nullptr), 0);
    v1::ClientMessage message;
    message.mutable_set_size()->set_width(4096);
    message.mutable_set_size()->set_height(4096);
    const uint64_t seq = greedy.send(message);
    const v1::Error error = greedy.expectError();
    EXPECT_EQ(error.code(), v1::ERROR_CODE_CAPACITY) << error.message();
    EXPECT_EQ(error.ref_seq(), seq);
    for (int i = 0; i < 3; ++i) {
        greedy.expectFrame([](const auto& header) { return header.width() <= 160; });
        viewer.expectFrame();
    }
    server.signal(SIGTERM);
    EXPECT_EQ(server.wait(20s).exit_code, 0);
}

TEST(Renderers, Flapping_LastOneWinsAndNothingIsLeftBehind) {
    ServerProcess server(kSmall);
    const uint16_t port = server.port().value();
    const uint16_t admin = server.adminPort().value();
    WsClient client(port);
    client.join();
    const auto round = [&](int times) {
        uint64_t seq = 0;
        for (int i = 0; i < times; ++i) {
            for (int renderer = 1; renderer <= 5; ++renderer) {
                seq = setRenderer(client, static_cast<v1::Renderer>(renderer));
            }
        }
        const v1::ViewState state = client.expectState(seq);
        // Its details, with the memory, come before it.
        client.expectFrame([&](const auto& header) { return header.applied_seq() >= seq; });
        return state.renderer();
    };
    const auto memory = [&] {
        const std::string text = metricsOf(admin);
        double sum = 0;
        for (size_t at = 0;
             (at = text.find("\nfroxel_device_memory_bytes{", at)) != std::string::npos; ++at) {
            sum += std::strtod(text.c_str() + text.find("} ", at) + 2, nullptr);
        }
        return sum;
    };
    // Every renderer is shown once, so that what is kept for it is there.
    for (int renderer = 1; renderer <= 5; ++renderer) {
        const uint64_t seq = setRenderer(client, static_cast<v1::Renderer>(renderer));
        client.expectFrame([&](const auto& header) { return header.applied_seq() >= seq; });
    }
    EXPECT_EQ(round(1), v1::RENDERER_TOON_COMPUTE);
    const double before = memory();
    EXPECT_GT(before, 0);
    EXPECT_EQ(round(40), v1::RENDERER_TOON_COMPUTE);
    EXPECT_EQ(memory(), before);
}

TEST(Sigterm, FirstPictureUnderWay_ExitsZero) {
    for (int i = 0; i < 3; ++i) {
        ServerProcess server(kSmall);
        WsClient client(server.port().value());
        client.join(); // its first picture needs pipelines, which take long to compile
        setRenderer(client, v1::RENDERER_FORWARD_PLUS);
        server.signal(SIGTERM);
        const auto end = server.wait(20s);
        EXPECT_EQ(end.exit_code, 0) << end.errors;
    }
}

// A client's name with newlines and escapes stays one line, cut; JSON lines stay JSON.
TEST(Log, ClientTextWithNewlines_IsEscapedOnOneLine) {
    for (const char* format : {"text", "json"}) {
        ServerProcess server({"--size", "160x90", "--log-format", format});
        {
            WsClient client(server.port().value());
            v1::ClientMessage hello;
            hello.mutable_hello()->set_protocol_major(protocol::kMajor);
            hello.mutable_hello()->set_client_name("x\nevent=forged \"\x1b[31m");
            client.send(hello);
            client.expect(v1::ServerMessage::kWelcome);
            v1::ClientMessage bad;
            bad.mutable_select_scene_camera()->set_name("\n\revent=forged");
            client.send(bad);
            client.expectError();
        }
        server.signal(SIGTERM);
        const auto end = server.wait(20s);
        EXPECT_EQ(end.exit_code, 0);
        EXPECT_EQ(end.errors.find("\nevent"), std::string::npos) << end.errors;
        EXPECT_EQ(end.errors.find('\x1b'), std::string::npos);
        EXPECT_EQ(end.errors.find('\r'), std::string::npos);
        for (const char* event : {"hello", "command_refused", "socket_closed"}) {
            const std::string wanted = format == std::string("json")
                                           ? "\"event\":\"" + std::string(event) + "\""
                                           : "event=" + std::string(event) + " ";
            EXPECT_NE(end.errors.find(wanted), std::string::npos) << wanted << end.errors;
        }
    }
}

} // namespace
} // namespace froxel::test

// What Agones' SDK hears of a server, and that viewers notice nothing of an SDK that does not work.
#include "integration/eventually.h"
#include "integration/sdk_mock.h"
#include "integration/server_process.h"
#include "integration/test_server.h"
#include "integration/ws_client.h"

#include <gtest/gtest.h>
#include <spdlog/sinks/ringbuffer_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>

namespace froxel::test {
namespace {

using namespace std::chrono_literals;
using Calls = std::vector<std::string>;

constexpr const char* kReady = "POST /ready";
constexpr const char* kAllocate = "POST /allocate";
constexpr const char* kShutdown = "POST /shutdown";
constexpr const char* kCounter = "PATCH /v1beta1/counters/sessions";

TestServerOptions with(uint16_t sdk_port) {
    return {.sessions_max = 4, .still = true, .agones = net::AgonesOptions{sdk_port, 4}};
}

// What is logged while it lives.
class Log {
  public:
    Log() { spdlog::set_default_logger(std::make_shared<spdlog::logger>("test", lines_)); }
    ~Log() { spdlog::set_default_logger(before_); }
    Log(const Log&) = delete;
    Log& operator=(const Log&) = delete;

    [[nodiscard]] int64_t count(const std::string& event) const {
        const auto lines = lines_->last_formatted();
        return std::count_if(lines.begin(), lines.end(), [&](const std::string& line) {
            return line.find(event) != std::string::npos;
        });
    }
    [[nodiscard]] bool comesTo(const std::string& event) const {
        return eventually([&] { return count(event) > 0; });
    }

  private:
    const std::shared_ptr<spdlog::sinks::ringbuffer_sink_mt> lines_ =
        std::make_shared<spdlog::sinks::ringbuffer_sink_mt>(1000);
    const std::shared_ptr<spdlog::logger> before_ = spdlog::default_logger();
};

TEST(Agones, SceneOpens_ReadyIsSaidOnceAndHealthFromTheStart) {
    const SdkMock sdk;
    TestServerOptions options = with(sdk.port());
    options.open_at_once = false;
    TestServer server(options);
    EXPECT_TRUE(eventually([&] { return sdk.healthCount() > 0; }));
    EXPECT_EQ(sdk.calls(), Calls()) << "ready before the scene is there";
    server.open();
    EXPECT_TRUE(sdk.comesToCounter("0/4"));
    const size_t health_count = sdk.healthCount();
    EXPECT_TRUE(eventually([&] { return sdk.healthCount() > health_count; }));
    EXPECT_EQ(sdk.calls(), (Calls{kReady, kCounter}));
}

TEST(Agones, Viewers_AllocateWhileOneIsThere_AndARoomCountsOnce) {
    const SdkMock sdk;
    TestServer server(with(sdk.port()));
    ASSERT_TRUE(sdk.comesToState(kReady));
    WsClient first(server.port());
    first.join("hall");
    EXPECT_TRUE(sdk.comesToState(kAllocate));
    EXPECT_TRUE(sdk.comesToCounter("1/4"));
    WsClient second(server.port());
    second.join("hall");
    WsClient third(server.port());
    third.join();
    EXPECT_TRUE(sdk.comesToCounter("2/4"));
    first.close();
    second.close();
    EXPECT_TRUE(sdk.comesToCounter("1/4"));
    third.close();
    EXPECT_TRUE(sdk.comesToState(kReady)) << "nobody is there: it may go";
    EXPECT_TRUE(sdk.comesToCounter("0/4"));
}

TEST(Agones, SdkIsNotThereYet_ViewersAreServed_AndItIsToldWhenItComes) {
    const Log log;
    const uint16_t port = SdkMock::freePort();
    TestServer server(with(port));
    WsClient client(server.port());
    client.join();
    client.expectFrame();
    ASSERT_TRUE(log.comesTo("event=agones_lost"));
    const SdkMock sdk(SdkMock::Answer::kAccepts, port);
    EXPECT_TRUE(sdk.comesToState(kAllocate));
    EXPECT_TRUE(sdk.comesToCounter("1/4"));
    const Calls calls = sdk.calls(); // each topic has its own time to try again
    EXPECT_LT(std::find(calls.begin(), calls.end(), kReady),
              std::find(calls.begin(), calls.end(), kAllocate));
    server.end();
    EXPECT_EQ(log.count("event=agones_lost"), 1);
    EXPECT_EQ(log.count("event=agones_back"), 1);
}

TEST(Agones, SdkFails_ViewersAreServed_AndItIsToldAgain) {
    const Log log;
    SdkMock sdk(SdkMock::Answer::kFails);
    TestServer server(with(sdk.port()));
    WsClient client(server.port());
    client.join();
    client.expectFrame();
    ASSERT_TRUE(log.comesTo("event=agones_refused path=/ready"));
    sdk.answer(SdkMock::Answer::kAccepts);
    EXPECT_TRUE(sdk.comesToState(kAllocate));
    EXPECT_TRUE(sdk.comesToCounter("1/4"));
    EXPECT_TRUE(eventually([&] { return sdk.healthCount() > 0; }));
    server.end();
    EXPECT_EQ(log.count("event=agones_refused path=/ready"), 1);
    EXPECT_EQ(log.count("event=agones_lost"), 0) << "it answers";
}

TEST(Agones, SdkHangs_ViewersAreServed_AndItIsToldAgain) {
    const Log log;
    SdkMock sdk(SdkMock::Answer::kHangs);
    TestServer server(with(sdk.port()));
    WsClient client(server.port());
    client.join();
    client.expectFrame();
    ASSERT_TRUE(log.comesTo("event=agones_lost"));
    sdk.answer(SdkMock::Answer::kAccepts);
    EXPECT_TRUE(sdk.comesToState(kAllocate));
    server.end();
    EXPECT_EQ(log.count("event=agones_lost"), 1);
    EXPECT_EQ(log.count("event=agones_back"), 1);
}

TEST(Agones, Drain_HasNoRoomAnyMore_AndEndsWithShutdown) {
    const SdkMock sdk;
    TestServer server(with(sdk.port()));
    WsClient client(server.port());
    client.join();
    ASSERT_TRUE(sdk.comesToCounter("1/4"));
    std::jthread drain([&] { server.run().drain(10s); });
    EXPECT_TRUE(sdk.comesToCounter("1/1"));
    EXPECT_EQ(sdk.calls().end()[-1], kCounter) << "its viewer is still there";
    client.close();
    drain.join();
    EXPECT_EQ(sdk.calls().back(), kShutdown);
}

TEST(Agones, Drain_SdkHangs_Ends) {
    const Log log;
    const SdkMock sdk(SdkMock::Answer::kHangs);
    TestServer server(with(sdk.port()));
    EXPECT_TRUE(server.run().drain(1s));
    server.end();
    EXPECT_EQ(log.count("event=agones_not_told"), 1);
}

TEST(Agones, Process_IsReadyOnce_AndShutsDownOnSigterm) {
    const SdkMock sdk;
    ASSERT_EQ(setenv("AGONES_SDK_HTTP_PORT", std::to_string(sdk.port()).c_str(), 1), 0);
    ServerProcess server({"--size", "160x90", "--lights", "50", "--agones"});
    ASSERT_EQ(unsetenv("AGONES_SDK_HTTP_PORT"), 0);
    ASSERT_TRUE(eventually([&] { return sdk.counter() == "0/16"; }, 60s));
    server.signal(SIGTERM);
    const auto end = server.wait(20s);
    EXPECT_EQ(end.exit_code, 0) << end.errors;
    EXPECT_EQ(sdk.calls().front(), kReady);
    EXPECT_EQ(sdk.calls().back(), kShutdown);
}

TEST(Agones, Port_IsNone_EndsTheStartWithOneLine) {
    ASSERT_EQ(setenv("AGONES_SDK_HTTP_PORT", "tcp", 1), 0);
    ServerProcess server({"--agones"});
    ASSERT_EQ(unsetenv("AGONES_SDK_HTTP_PORT"), 0);
    const auto end = server.wait(20s);
    EXPECT_EQ(end.exit_code, 2);
    EXPECT_NE(end.errors.find("AGONES_SDK_HTTP_PORT: 'tcp' is not a port"), std::string::npos)
        << end.errors;
}

} // namespace
} // namespace froxel::test

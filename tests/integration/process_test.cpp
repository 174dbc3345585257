// The real binary, renderer and all, as a user starts and stops it.
#include "integration/http_exchange.h"
#include "integration/server_process.h"
#include "integration/ws_client.h"
#include "support/places.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <algorithm>
#include <csignal>
#include <memory>

namespace froxel::test {
namespace {

using namespace std::chrono_literals;

const std::vector<std::string> kSmall = {"--size", "160x90", "--lights", "50"};

// Grey levels of a JPEG.
std::vector<unsigned char> greyOf(const Frame& frame) {
    const std::unique_ptr<void, int (*)(void*)> decoder(tjInitDecompress(), &tjDestroy);
    std::vector<unsigned char> grey(size_t{frame.header.width()} * frame.header.height());
    const int failed =
        tjDecompress2(decoder.get(), reinterpret_cast<const unsigned char*>(frame.jpeg.data()),
                      frame.jpeg.size(), grey.data(), static_cast<int>(frame.header.width()), 0,
                      static_cast<int>(frame.header.height()), TJPF_GRAY, 0);
    EXPECT_EQ(failed, 0) << tjGetErrorStr2(decoder.get());
    return grey;
}

void expectPicture(const Frame& frame) {
    const auto grey = greyOf(frame);
    const auto [darkest, brightest] = std::minmax_element(grey.begin(), grey.end());
    EXPECT_GT(*brightest - *darkest, 40) << "one flat colour is no picture of a scene";
}

TEST(ServeProcess, BuiltinScene_EveryRenderer_SendsAPictureWithItsTimes) {
    ServerProcess server(kSmall);
    WsClient client(server.port().value());
    const v1::Welcome welcome = client.join();
    EXPECT_GE(welcome.scene().triangles(), 100'000U);
    EXPECT_GE(welcome.scene().cameras_size(), 5);
    for (const auto renderer :
         {v1::RENDERER_NAIVE, v1::RENDERER_FORWARD_PLUS, v1::RENDERER_CLUSTERED_DEFERRED,
          v1::RENDERER_TOON_FRAGMENT, v1::RENDERER_TOON_COMPUTE}) {
        v1::ClientMessage message;
        message.mutable_set_renderer()->set_renderer(renderer);
        const uint64_t seq = client.send(message);
        const Frame frame =
            client.expectFrame([&](const auto& header) { return header.applied_seq() >= seq; });
        expectPicture(frame);
        EXPECT_EQ(frame.header.light_count() >= 50, true) << frame.header.light_count();
        EXPECT_GT(frame.header.passes_size(), 0);
        EXPECT_GT(frame.header.render_us(), 0U);
        EXPECT_GT(frame.header.encode_us(), 0U);
    }
}

TEST(ServeProcess, TwoViewers_OddSizes_GetPicturesOfTheirOwn) {
    ServerProcess server(kSmall);
    const uint16_t port = server.port().value();
    WsClient first(port);
    first.join();
    WsClient second(port); // later: a silent connection is closed after 5 s
    second.join();
    for (const auto& [width, height] : {std::pair{17U, 161U}, {333U, 99U}, {16U, 16U}}) {
        v1::ClientMessage message;
        message.mutable_set_size()->set_width(width);
        message.mutable_set_size()->set_height(height);
        const uint64_t seq = first.send(message);
        const Frame odd =
            first.expectFrame([&](const auto& header) { return header.applied_seq() >= seq; });
        EXPECT_EQ(odd.header.width(), width);
        EXPECT_EQ(greyOf(odd).size(), size_t{width} * height);
        EXPECT_EQ(second.expectFrame().header.width(), 160U);
    }
    first.abort();
    expectPicture(second.expectFrame());
}

TEST(ServeProcess, Sigterm_ViewerConnected_IsToldAndExitsZero) {
    ServerProcess server(kSmall);
    WsClient client(server.port().value());
    client.join();
    client.expectFrame();
    server.signal(SIGTERM);
    client.expect(v1::ServerMessage::kDraining);
    EXPECT_EQ(client.expectClosed().code, 4010);
    const auto end = server.wait(10s);
    EXPECT_EQ(end.exit_code, 0) << end.errors;
}

TEST(ServeProcess, Sigterm_ViewerNeverAnswers_ExitsZeroByTheDeadline) {
    ServerProcess server(kSmall);
    WsClient client(server.port().value());
    client.join();
    client.expectFrame();
    server.signal(SIGINT);
    const auto end = server.wait(15s);
    EXPECT_EQ(end.exit_code, 0) << end.errors;
}

TEST(ServeProcess, Sigterm_WhileLoading_ExitsZero) {
    ServerProcess server(kSmall);
    ASSERT_TRUE(server.port());
    server.signal(SIGTERM);
    const auto end = server.wait(15s);
    EXPECT_EQ(end.exit_code, 0) << end.errors;
}

TEST(ServeProcess, Sigterm_Twice_EndsAtOnce) {
    ServerProcess server(kSmall);
    WsClient client(server.port().value());
    client.join();
    client.expectFrame();
    server.signal(SIGTERM);
    client.expect(v1::ServerMessage::kDraining); // it drains, and this viewer will not answer
    server.signal(SIGTERM);
    EXPECT_EQ(server.wait(3s).signal, SIGTERM);
}

// A step of the render thread that takes longer than the watchdog's time stands for a device that
// does not come back.
TEST(ServeProcess, RenderThreadStandsStill_ViewersAreToldAndItExitsSix) {
    ServerProcess server({"--size", "1280x720", "--watchdog-seconds", "0.02"});
    WsClient client(server.port().value());
    client.hello();
    EXPECT_EQ(client.expectError().code(), v1::ERROR_CODE_DEVICE);
    EXPECT_EQ(client.expectClosed().code, 4050);
    const auto end = server.wait(10s);
    EXPECT_EQ(end.exit_code, 6) << end.errors;
    EXPECT_NE(end.errors.find("event=device_stuck"), std::string::npos) << end.errors;
}

TEST(ServeProcess, PostDrain_AtTheAdminAddress_EndsAsSigtermDoes) {
    ServerProcess server(kSmall);
    ASSERT_TRUE(server.port());
    const uint16_t admin = server.adminPort().value();
    EXPECT_EQ(statusOf(httpGet(admin, "/drain")), 405);
    const std::string post = "POST /drain HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n";
    EXPECT_EQ(statusOf(httpExchange(admin, post + "Origin: http://evil.example\r\n\r\n")), 403);
    EXPECT_EQ(statusOf(httpExchange(admin, post + "\r\n")), 202);
    EXPECT_EQ(server.wait(15s).exit_code, 0);
}

TEST(ServeProcess, Port_InUse_ExitsFiveAndNamesIt) {
    ServerProcess first(kSmall);
    const uint16_t port = first.port().value();
    ServerProcess second(kSmall, port);
    const auto end = second.wait(20s);
    EXPECT_EQ(end.exit_code, 5);
    EXPECT_NE(end.errors.find(std::to_string(port)), std::string::npos) << end.errors;
}

TEST(ServeProcess, AdminPort_InUse_ExitsFiveAndNamesTheOption) {
    ServerProcess first(kSmall);
    const std::string taken = "127.0.0.1:" + std::to_string(first.port().value());
    ChildProcess second({test::binaryPath(), "serve", "--port", "0", "--admin-bind", taken});
    const auto end = second.wait(20s);
    EXPECT_EQ(end.exit_code, 5);
    EXPECT_EQ(end.output, "") << "nothing is served";
    EXPECT_NE(end.errors.find("--admin-bind"), std::string::npos) << end.errors;
}

TEST(ServeProcess, AdminBind_None_PrintsOneAddress) {
    ChildProcess server(
        {test::binaryPath(), "serve", "--device", "cpu", "--port", "0", "--admin-bind", "none"});
    EXPECT_NE(server.readLine(), "");
    server.signal(SIGTERM);
    const auto end = server.wait(15s);
    EXPECT_EQ(end.exit_code, 0) << end.errors;
    EXPECT_EQ(end.output, "");
}

TEST(ServeProcess, Scene_Missing_ExitsThreeAndNamesIt) {
    ServerProcess server({"--scene", "/no/such/scene.glb"});
    const auto end = server.wait(20s);
    EXPECT_EQ(end.exit_code, 3) << end.errors;
    EXPECT_NE(end.errors.find("scene.glb"), std::string::npos) << end.errors;
    EXPECT_NE(end.errors.find("/no/such"), std::string::npos) << end.errors;
}

TEST(ServeProcess, Address_NotOurs_FailsAndNamesIt) {
    ServerProcess server({"--address", "203.0.113.7"});
    const auto end = server.wait(20s);
    EXPECT_EQ(end.exit_code, 1) << end.errors;
    EXPECT_NE(end.errors.find("203.0.113.7"), std::string::npos) << end.errors;
}

} // namespace
} // namespace froxel::test

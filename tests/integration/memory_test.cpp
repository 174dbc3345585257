// What two viewers who ask for as much as they can take of the process's memory.
#include "integration/http_exchange.h"
#include "integration/server_process.h"
#include "integration/ws_client.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <optional>

namespace froxel::test {
namespace {

using namespace std::chrono_literals;

constexpr double kMib = 1 << 20U;
constexpr uint32_t kSession_mib = 128;

double residentMib(uint16_t admin_port) {
    const std::string text = bodyOf(httpGet(admin_port, "/metrics"));
    const std::string name = "\nprocess_resident_memory_bytes ";
    return std::stod(text.substr(text.find(name) + name.size())) / kMib;
}

v1::ClientMessage sizeOf(uint32_t width, uint32_t height) {
    v1::ClientMessage message;
    message.mutable_set_size()->set_width(width);
    message.mutable_set_size()->set_height(height);
    return message;
}

class SessionMemory : public testing::Test {
  protected:
    SessionMemory()
        : server_({"--size", "160x90", "--lights", "20", "--frame-limit", "60", "--session-memory",
                   std::to_string(kSession_mib)}),
          port_(server_.port().value()), admin_(server_.adminPort().value()), one_(port_) {
        one_.join();
        two_.emplace(port_).join();
        one_.expectFrame();
        two_->expectFrame();
        before_ = residentMib(admin_);
    }

    ServerProcess server_;
    uint16_t port_;
    uint16_t admin_;
    WsClient one_;
    std::optional<WsClient> two_; // later: a silent connection is closed after 5 s
    double before_ = 0;           // both see pictures of the first size
};

TEST_F(SessionMemory, PicturesOf4096_AreRefusedAndTakeNothing) {
    for (WsClient* viewer : {&one_, &*two_}) {
        viewer->send(sizeOf(4096, 4096));
        const v1::Error error = viewer->expectError();
        EXPECT_EQ(error.code(), v1::ERROR_CODE_CAPACITY) << error.message();
        EXPECT_NE(error.message().find("a session may have 128"), std::string::npos)
            << error.message();
        viewer->expectFrame([](const auto& header) { return header.width() <= 160; });
    }
    EXPECT_LT(residentMib(admin_), before_ + 32);
}

TEST_F(SessionMemory, LargePicturesThatAreDrawn_StayWithinTheBudget) {
    const auto isLarge = [](const auto& header) { return header.width() == 1600; };
    const std::array<WsClient*, 2> viewers = {&one_, &*two_};
    // In turns: neither is silent for so long that it would be taken for gone.
    for (WsClient* viewer : viewers) {
        viewer->send(sizeOf(1600, 900));
    }
    for (int i = 0; i < 4; ++i) { // every readback buffer
        for (WsClient* viewer : viewers) {
            viewer->expectFrame(isLarge);
        }
    }
    for (WsClient* viewer : viewers) {
        viewer->send(sizeOf(2560, 1440));
        EXPECT_EQ(viewer->expectError().code(), v1::ERROR_CODE_CAPACITY);
        viewer->expectFrame(isLarge);
    }
    const double grown = residentMib(admin_) - before_;
    std::printf("resident memory grew by %.0f MiB for two viewers\n", grown);
    EXPECT_LT(grown, 2 * kSession_mib);
}

} // namespace
} // namespace froxel::test

// How a server ends whose device does not come back.
#include "integration/child_process.h"
#include "integration/ws_client.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <string>

namespace froxel::test {
namespace {

using namespace std::chrono_literals;

class HangingServer : public ChildProcess {
  public:
    HangingServer(const std::string& wait_ms, const std::string& watchdog_ms)
        : ChildProcess({HANGING_SERVER, wait_ms, watchdog_ms}) {
        const std::string url = readLine();
        port_ = static_cast<uint16_t>(std::atoi(url.substr(url.rfind(':') + 1).c_str()));
    }
    [[nodiscard]] uint16_t port() const { return port_; }

  private:
    uint16_t port_ = 0;
};

size_t countOf(const std::string& text, const std::string& part) {
    size_t count = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++count;
    }
    return count;
}

void expectToldAndSix(HangingServer& server, const char* event) {
    WsClient client(server.port());
    client.hello();
    EXPECT_EQ(client.expectError().code(), v1::ERROR_CODE_DEVICE);
    EXPECT_EQ(client.expectClosed().code, 4050);
    const auto end = server.wait(20s);
    EXPECT_EQ(end.exit_code, 6) << end.signal << end.errors;
    EXPECT_EQ(countOf(end.errors, " error "), 1U) << end.errors;
    EXPECT_NE(end.errors.find(event), std::string::npos) << end.errors;
}

TEST(DeviceEnd, WaitEndsInVain_ViewersAreToldAndItExitsSixWithOneLine) {
    HangingServer server("200", "0");
    expectToldAndSix(server, "event=device_lost");
}

TEST(DeviceEnd, DriverNeverReturns_WatchdogTellsAndItExitsSixWithOneLine) {
    HangingServer server("0", "300");
    expectToldAndSix(server, "event=device_stuck");
}

TEST(DeviceEnd, LostAfterSigterm_ExitsSix) {
    HangingServer server("1500", "0");
    WsClient client(server.port());
    client.join();
    EXPECT_EQ(server.readLine(), "the device has a piece");
    server.signal(SIGTERM);
    const auto end = server.wait(20s);
    EXPECT_EQ(end.exit_code, 6) << end.signal << end.errors;
    EXPECT_NE(end.errors.find("event=draining"), std::string::npos) << end.errors;
    EXPECT_NE(end.errors.find("event=device_lost"), std::string::npos) << end.errors;
}

TEST(DeviceEnd, DriverNeverReturnsAndSigterm_EndsNevertheless) {
    HangingServer server("0", "0");
    WsClient client(server.port());
    client.join();
    server.signal(SIGTERM);
    const auto end = server.wait(20s);
    EXPECT_EQ(end.exit_code, 0) << end.signal << end.errors;
}

} // namespace
} // namespace froxel::test

// A whole server in this process, on a free port of 127.0.0.1, with a fake device behind it.
#pragma once

#include "app/serve_run.h"
#include "support/fake_frame_source.h"

#include <memory>
#include <optional>

namespace froxel::test {

struct TestServerOptions {
    uint32_t sessions_max = 8;
    uint32_t connections_max = 256;
    settings::Size size{64, 48};
    bool still = false; // lights stand still until a command moves them: pictures only on change
    std::chrono::milliseconds resume_grace{0};
    double min_rate_hz = 0;
    bool open_at_once = true; // false: the scene keeps loading until open()
    std::vector<std::string> allowed_origins{};
    std::vector<std::string> trusted_proxies{};
    std::vector<std::string> host_names{};
    std::filesystem::path web_root{};
    std::optional<net::AgonesOptions> agones{};
    net::LobbyRules rules{}; // but for what is said above
};

class TestServer {
  public:
    explicit TestServer(const TestServerOptions& options = {});
    ~TestServer();

    [[nodiscard]] uint16_t port() const { return run_->port(); }
    [[nodiscard]] uint16_t adminPort() const { return run_->adminPort().value(); }
    [[nodiscard]] FakeDevice& device() { return *device_; }
    [[nodiscard]] app::ServeRun& run() { return *run_; }
    void open();
    // Destroys the server; what it leaves behind can be looked at.
    void end();

  private:
    std::shared_ptr<FakeDevice> device_ = std::make_shared<FakeDevice>();
    std::mutex mutex_;
    std::condition_variable changed_;
    bool opened_ = false;
    std::optional<app::ServeRun> run_;
};

} // namespace froxel::test

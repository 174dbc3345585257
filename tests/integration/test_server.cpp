#include "integration/test_server.h"

#include <utility>

namespace froxel::test {
namespace {

session::SessionContext contextFor(const TestServerOptions& options) {
    session::SessionContext context;
    context.scene.name = "fake";
    context.scene.bounds_world.add({-1, -1, -1});
    context.scene.bounds_world.add({1, 1, 1});
    settings::Camera side = settings::lookAt({5, 0, 0}, {0, 0, 0}, {0, 1, 0});
    context.scene.cameras = {{"front", settings::lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0})},
                             {"side", side}};
    context.defaults.settings.size = options.size;
    context.defaults.settings.lights.count = options.still ? 0 : 100;
    context.defaults.min_rate_hz = options.min_rate_hz;
    context.server_version = "test";
    context.device_name = "fake device";
    return context;
}

} // namespace

TestServer::TestServer(const TestServerOptions& options) : opened_(options.open_at_once) {
    app::ServeRunOptions run;
    run.server.admin = {"127.0.0.1", 0};
    run.server.connections_max = options.connections_max;
    run.server.allowed_origins = options.allowed_origins;
    run.server.trusted_proxies = options.trusted_proxies;
    run.server.host_names = options.host_names;
    run.server.lobby = options.rules;
    run.server.lobby.resume_grace = options.resume_grace;
    run.server.lobby.sessions_max = options.sessions_max;
    run.server.web_root = options.web_root;
    run.server.agones = options.agones;
    run.server.thread_count = 2;
    run.encoder_count = 2;
    run.open = [this, context = contextFor(options)](const auto& report) {
        report({"loading the scene", 0.25});
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return opened_; });
        return app::OpenedScene{makeFakeSource(device_), context, [] {
                                    return std::vector<MemoryUse>{{"pixels", 4096}};
                                }};
    };
    run.on_failure = [](const Error&) {};
    run_.emplace(std::move(run));
}

TestServer::~TestServer() {
    end();
}

void TestServer::open() {
    const std::lock_guard lock(mutex_);
    opened_ = true;
    changed_.notify_all();
}

void TestServer::end() {
    open();
    run_.reset();
}

} // namespace froxel::test

#include "app/serve_command.h"

#include "app/bind_option.h"
#include "app/output_file.h"
#include "app/scene_source.h"
#include "app/serve_run.h"
#include "core/latest_slot.h"
#include "core/text.h"
#include "gpu/device.h"
#include "net/stop_signal.h"
#include "stream/renderer_source.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <malloc.h>
#include <system_error>
#include <thread>
#include <utility>

namespace froxel::app {

namespace {

namespace fs = std::filesystem;

// After this long, viewers that have not closed are dropped.
constexpr std::chrono::seconds kDrainDeadline{5};

session::SessionDefaults defaultsOf(const ServeOptions& options, bool device_is_cpu) {
    auto defaults =
        session::defaultsFor(device_is_cpu ? session::DeviceKind::kCpu : session::DeviceKind::kGpu);
    defaults.size = options.size.value_or(defaults.size);
    defaults.encoding.quality = options.quality.value_or(defaults.encoding.quality);
    defaults.light_count = options.light_count.value_or(defaults.light_count);
    defaults.light_radius_m = static_cast<float>(
        options.light_radius_m.value_or(static_cast<double>(defaults.light_radius_m)));
    defaults.renderer = options.renderer.value_or(defaults.renderer);
    defaults.min_rate_hz = options.min_rate_hz.value_or(defaults.min_rate_hz);
    defaults.delivery = options.delivery;
    defaults.other = options.other;
    defaults.lens_shift = options.lens_shift;
    return defaults;
}

// On the render thread, which owns all of it from then on.
OpenedScene openScene(const ServeOptions& options,
                      const std::function<void(net::LoadingProgress)>& report) {
    report({"opening the device", 0.0});
    auto device =
        std::make_unique<gpu::Device>(gpu::DeviceOptions{.choice = options.device,
                                                         .pipeline_cache = options.pipeline_cache,
                                                         .validation = options.validation});
    const gpu::DeviceTraits& traits = device->traits();

    report({"loading the scene", 0.1});
    const scene::Scene scene = loadScene(options.scene).value();
    for (const std::string& warning : scene.warnings) {
        spdlog::warn("event=scene_warning text={}", logValue(warning, 400));
    }
    session::SessionContext context{session::summarize(scene), defaultsOf(options, traits.is_cpu),
                                    FROXEL_VERSION, traits.name};
    spdlog::info("event=scene_loaded scene={} triangles={} draws={} cameras={}",
                 logValue(context.scene.name), context.scene.triangle_count,
                 context.scene.draw_count, context.scene.cameras.size());

    report({"moving the scene to the device", 0.6});
    auto source = stream::makeRendererSource(std::move(device), scene);
    report({"ready", 1.0});
    return {std::move(source), std::move(context)};
}

fs::path webRootOf(const ServeOptions& options) {
    auto root = findWebRoot(options.web_root);
    if (root.empty()) {
        spdlog::warn("no page found; ./deploy/build.sh makes it, --web-root names another");
    }
    return root;
}

ServeRunOptions runOptions(const ServeOptions& options) {
    const uint32_t cores = std::max(1U, std::thread::hardware_concurrency());
    ServeRunOptions run;
    run.server.version = FROXEL_VERSION;
    run.server.bind = {options.address, options.port};
    run.server.admin = options.admin;
    run.server.thread_count = std::clamp(cores / 8, 1U, 4U);
    run.server.connections_max = 256 + 4 * options.sessions_max;
    run.server.resume_grace =
        std::chrono::duration_cast<std::chrono::milliseconds>(Seconds(options.resume_grace_s));
    run.server.web_root = webRootOf(options);
    run.server.allowed_origins = options.allowed_origins;
    run.sessions_max = options.sessions_max;
    run.encoder_count = std::clamp(cores / 2, 1U, 16U);
    run.open = [options](const auto& report) { return openScene(options, report); };
    return run;
}

} // namespace

int runServe(const ServeOptions& options) {
    // Whoever compiles shaders on many threads leaves holes in an arena for each of them, 0.1 MB
    // for every viewer that asks for other variants; two arenas stay as they are
    // (tests/load/soak.py).
    mallopt(M_ARENA_MAX, 2);
    net::StopSignal stop;
    LatestSlot<Error> failure; // of the render thread
    ServeRunOptions run_options = runOptions(options);
    run_options.on_failure = [&](const Error& error) {
        failure.put(error);
        stop.request();
    };
    ServeRun run(std::move(run_options));
    std::printf("%s\n", urlOf(options.address, run.port()).c_str());
    if (const auto admin_port = run.adminPort()) {
        std::printf("%smetrics\n", urlOf(options.admin.address, *admin_port).c_str());
    }
    std::fflush(stdout);

    const int signal = stop.wait();
    spdlog::info("event=draining signal={}", signal);
    const bool all_closed = run.drain(kDrainDeadline);
    spdlog::info("event=drained all_closed={}", all_closed);
    if (auto error = failure.take()) {
        throw StartupError(std::move(*error));
    }
    if (!run.opened()) {
        // Still loading, which cannot be interrupted, and nobody has anything to lose.
        spdlog::shutdown();
        std::quick_exit(EXIT_SUCCESS);
    }
    return EXIT_SUCCESS;
}

} // namespace froxel::app

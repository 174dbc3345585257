#include "app/serve_command.h"

#include "app/bind_option.h"
#include "app/device_losses.h"
#include "app/output_file.h"
#include "app/scene_maker.h"
#include "app/scene_source.h"
#include "app/serve_end.h"
#include "app/serve_run.h"
#include "app/value_parsers.h"
#include "core/latest_slot.h"
#include "core/text.h"
#include "core/write_soon.h"
#include "gpu/device.h"
#include "guest/guest_store.h"
#include "net/host_names.h"
#include "net/stop_signal.h"
#include "net/tls.h"
#include "net/token_gate.h"
#include "render/view/memory_report.h"
#include "stream/renderer_source.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <malloc.h>
#include <optional>
#include <sys/resource.h>
#include <system_error>
#include <thread>
#include <utility>

namespace froxel::app {

namespace {

namespace fs = std::filesystem;

std::chrono::milliseconds milliseconds(double seconds) {
    return std::chrono::duration_cast<std::chrono::milliseconds>(Seconds(seconds));
}

void tellMemory(const render::MemoryLimits& limits, uint32_t sessions_max) {
    constexpr uint64_t kMib = 1 << 20U;
    spdlog::info("event=memory_limits device_mib={} session_mib={}", limits.device_bytes / kMib,
                 limits.session_bytes / kMib);
    if (limits.device_bytes / sessions_max < limits.session_bytes) {
        spdlog::warn("event=memory_overcommitted device_mib={} session_mib={} sessions={} "
                     "advice=\"lower --session-memory or --max-sessions, or raise --device-memory: "
                     "a session may find no memory left\"",
                     limits.device_bytes / kMib, limits.session_bytes / kMib, sessions_max);
    }
}

// A third of the weight of the render thread.
constexpr int kCpuDeviceNiceness = 5;

// Threads of each lane of the encoders.
uint32_t encoderCount() {
    return std::max(1U, std::thread::hardware_concurrency() / 2);
}

// On the render thread, which owns all of it from then on.
OpenedScene openScene(const ServeOptions& options, const ProgressReport& report) {
    report({"opening the device", 0.0});
    auto device = gpu::openForServing({.choice = options.device,
                                       .pipeline_cache = options.pipeline_cache,
                                       .validation = options.validation},
                                      kCpuDeviceNiceness);
    const gpu::DeviceTraits& traits = device->traits();

    report({"loading the scene", 0.1});
    auto maker = std::make_shared<const SceneMaker>(options, traits);
    const auto reading = [&](const Progress& progress) {
        return report({progress.stage, 0.1 + 0.5 * progress.fraction});
    };
    stream::ReadScene first =
        maker->make(options.scene, options.choices, reading, {.memory_bytes = readMemoryBytes()})
            .value();
    spdlog::info("event=scene_loaded scene={} triangles={} draws={} cameras={}",
                 logValue(first.context.scene.name), first.context.scene.triangle_count,
                 first.context.scene.draw_count, first.context.scene.cameras.size());

    const bool on_cpu = traits.is_cpu;
    auto memory = [ledger = device->memoryLedger()] { return render::memoryReport(*ledger); };
    report({"moving the scene to the device", 0.6});
    const render::MemoryLimits limits = memoryLimits(options.memory, *device);
    tellMemory(limits, options.sessions_max);
    auto source = stream::makeRendererSource(
        std::move(device), *first.scene, first.context.first_view.cameraFor(settings::Size{}),
        Seconds(options.frame_limit_s), limits,
        {.detail_levels = options.detail_levels, .geometry_cache = options.pipeline_cache.folder},
        {options.jpeg_encoder, encoderCount()});
    report({"ready", 1.0});
    const double limit_s = options.watchdog_s.value_or(on_cpu ? kCpuWatchdog_s : kGpuWatchdog_s);
    const uint64_t scene_bytes = sceneMemoryBytes(options.memory, limits);
    const auto shares = std::make_shared<ReadShares>();
    return {std::move(source),
            std::move(first.context),
            std::move(memory),
            Seconds(limit_s),
            first.scene->files,
            [maker, scene_bytes, shares](const catalogue::Offered& offered,
                                         const ProgressReport& report_on) {
                const auto share = shares->take(scene_bytes);
                return maker->make(offered.source, {}, report_on, {*share, true});
            },
            [maker, scene_bytes, shares](const auto& brought, const ProgressReport& report_on) {
                const auto share = shares->take(scene_bytes);
                return maker->makeGuest(brought, report_on, *share);
            },
            scene_bytes};
}

fs::path webRootOf(const ServeOptions& options) {
    auto root = findWebRoot(options.web_root);
    if (root.empty()) {
        spdlog::warn("the built page was not found; run ./deploy/build.sh, or name its folder with "
                     "--web-root");
    }
    return root;
}

// Agones sets the variable for every container that has its SDK beside it.
net::AgonesOptions agonesOptions(const ServeOptions& options) {
    net::AgonesOptions agones;
    agones.sessions_max = options.sessions_max;
    constexpr const char* kVariable = "AGONES_SDK_HTTP_PORT";
    if (const char* port = std::getenv(kVariable)) {
        const auto number = parseNumber(port, kPortRange);
        if (!number || *number == 0) {
            throw StartupError({ErrorCode::kInvalidArgument,
                                std::string(kVariable) + ": '" + printable(port) +
                                    "' is not a port; expected a number from 1 to 65535"});
        }
        agones.port = static_cast<uint16_t>(*number);
    }
    return agones;
}

net::LobbyRules lobbyRules(const ServeOptions& options) {
    net::LobbyRules rules;
    rules.resume_grace = milliseconds(options.resume_grace_s);
    rules.sessions_max = options.sessions_max;
    rules.sessions_per_address =
        options.sessions_per_address.value_or(std::max(1U, options.sessions_max / 2));
    rules.sessions_per_token = options.sessions_per_token;
    rules.viewers_per_room = options.viewers_per_room;
    rules.viewers_per_room_and_address = (options.viewers_per_room + 1) / 2;
    rules.rest = {Seconds(options.paused_s), Seconds(options.idle_s)};
    rules.forget = Seconds(options.forget_s);
    rules.control_idle = Seconds(options.control_idle_s);
    return rules;
}

bool takesUploads(const ServeOptions& options) {
    const bool own = net::isLoopback(options.address) && options.host_names.empty();
    const bool trusted = own || !options.token_file.empty();
    const bool read = options.sandbox != bake::Sandbox::kOff;
    const bool kept = !options.uploads.folder.empty() || !options.pipeline_cache.folder.empty();
    if (options.uploads.from == UploadsFrom::kOn && !(read && kept)) {
        throw StartupError({ErrorCode::kInvalidArgument,
                            read ? "--uploads needs a folder to keep them in; expected "
                                   "--upload-folder"
                                 : "--uploads needs a process that reads them; expected --sandbox "
                                   "best or require"});
    }
    return options.uploads.from == UploadsFrom::kOn ||
           (options.uploads.from == UploadsFrom::kAuto && trusted && read && kept);
}

// The scene that the server begins with, the hall, and what the folder holds; null: there is none
// but the first.
std::shared_ptr<catalogue::Catalogue> catalogueOf(const ServeOptions& options) {
    if (options.scenes.empty() && !takesUploads(options)) {
        return nullptr;
    }
    const catalogue::Offered hall{"builtin", "hall", "", "builtin", 0, 0};
    std::vector<catalogue::Offered> always{hall};
    if (!isBuiltin(options.scene)) {
        std::error_code gone; // reading it says so
        if (auto first = catalogue::offerFile(options.scene, options.scenes, gone)) {
            always.insert(always.begin(), std::move(*first));
        }
    }
    return std::make_shared<catalogue::Catalogue>(std::move(always), options.scenes);
}

// Null: clients may bring none that stay.
std::shared_ptr<guest::GuestStore> guestStore(const ServeOptions& options) {
    if (!takesUploads(options)) {
        return nullptr;
    }
    const UploadOptions& uploads = options.uploads;
    const fs::path folder =
        uploads.folder.empty() ? options.pipeline_cache.folder / "uploads" : uploads.folder;
    guest::StoreLimits limits;
    limits.file_bytes = uint64_t{uploads.file_mib} << 20U;
    limits.all_bytes = uint64_t{uploads.all_mib} << 20U;
    limits.kept = std::chrono::hours(uploads.kept_hours);
    try {
        return std::make_shared<guest::GuestStore>(folder, limits,
                                                   std::chrono::system_clock::now());
    } catch (const StartupError& error) {
        if (uploads.from == UploadsFrom::kOn) {
            throw;
        }
        spdlog::warn("event=uploads_off reason={}", logValue(error.what(), 400));
        return nullptr;
    }
}

ServeRunOptions runOptions(const ServeOptions& options) {
    const uint32_t cores = std::max(1U, std::thread::hardware_concurrency());
    ServeRunOptions run;
    run.server.version = FROXEL_VERSION;
    run.server.bind = {options.address, options.port};
    run.server.admin = options.admin;
    run.server.thread_count = std::max(1U, cores / 8);
    run.server.connections_max = options.connections_max;
    run.server.lobby = lobbyRules(options);
    run.server.stills.per_minute = options.stills_per_minute;
    run.server.stills.at_once = std::max(1.0, options.stills_per_minute / 10.0);
    const bool isolated = options.sandbox != bake::Sandbox::kOff;
    run.server.guest_body_bytes = isolated ? uint64_t{options.body_mib} << 20U : 0;
    run.server.guest_store = guestStore(options);
    run.server.web_root = webRootOf(options);
    run.server.allowed_origins = options.allowed_origins;
    run.server.host_names = options.host_names;
    run.server.trusted_proxies = options.trusted_proxies;
    if (options.agones) {
        run.server.agones = agonesOptions(options);
    }
    run.offers_depth = !options.no_depth;
    run.encoder_count = encoderCount();
    run.catalogue = catalogueOf(options);
    run.server.catalogue = run.catalogue;
    run.open = [options](const auto& report) { return openScene(options, report); };
    return run;
}

// One a connection, and some for the rest.
void raiseDescriptorLimit(uint32_t connections) {
    constexpr rlim_t kOthers = 128;
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0) {
        return;
    }
    limit.rlim_cur = limit.rlim_max;
    if (setrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < connections + kOthers) {
        spdlog::warn("event=few_descriptors limit={} connections={}", limit.rlim_cur, connections);
    }
}

// What is read again on SIGHUP.
struct Secrets {
    explicit Secrets(const ServeOptions& options)
        : token_file(options.token_file), admin_token_file(options.admin_token_file),
          gate(gateOf(token_file)), admin_gate(gateOf(admin_token_file)) {
        if (!options.tls_key.empty()) {
            tls = std::make_shared<net::Tls>(options.tls_certificate, options.tls_key);
        }
    }
    static std::shared_ptr<net::TokenGate> gateOf(const std::filesystem::path& file) {
        auto gate = file.empty() ? nullptr : std::make_shared<net::TokenGate>();
        if (gate) {
            gate->load(file).value();
        }
        return gate;
    }
    void reload() const {
        const auto told = [](const char* what, const Result<void>& done) {
            if (done) {
                spdlog::info("event=reloaded what={}", what);
            } else {
                spdlog::error("event=not_reloaded what={} reason={}", what,
                              logValue(done.error().message, 400));
            }
        };
        if (gate) {
            told("tokens", gate->load(token_file));
        }
        if (admin_gate) {
            told("admin_tokens", admin_gate->load(admin_token_file));
        }
        if (tls) {
            told("certificate", tls->reload());
        }
        if (!gate && !admin_gate && !tls) {
            spdlog::info("event=nothing_to_reload");
        }
    }

    const std::filesystem::path token_file;
    const std::filesystem::path admin_token_file;
    const std::shared_ptr<net::TokenGate> gate;
    const std::shared_ptr<net::TokenGate> admin_gate;
    std::shared_ptr<net::Tls> tls;
};

void printAddresses(const ServeOptions& options, const ServeRun& run) {
    const std::string scheme = options.tls_key.empty() ? "http" : "https";
    std::string lines = urlOf(options.address, run.port(), scheme) + "\n";
    if (const auto admin_port = run.adminPort()) {
        lines += urlOf(options.admin.address, *admin_port) + "metrics\n";
    }
    if (!writeSoon(STDOUT_FILENO, lines)) {
        spdlog::warn("event=addresses_not_printed");
    }
}

} // namespace

int runServe(const ServeOptions& options) {
    // Whoever compiles shaders on many threads leaves holes in an arena for each of them, 0.1 MB
    // for every viewer that asks for other variants; two arenas stay as they are
    // (tests/load/soak.py).
    mallopt(M_ARENA_MAX, 2);
    // Large blocks (pictures, targets of a CPU device, scenes, answers) are mapped and go back to
    // the system when they are freed. The threshold that grows by itself, up to 32 MiB, leaves them
    // among small ones: 450 MB of holes after five minutes of tests/load/soak_busy.py, 60 with
    // this.
    mallopt(M_MMAP_THRESHOLD, 256 * 1024);
    raiseDescriptorLimit(options.connections_max);
    const Secrets secrets(options);
    net::StopSignal stop;
    LatestSlot<Error> failure; // of the render thread
    std::optional<ServeRun> run;
    stop.onHangup([&] {
        secrets.reload();
        if (run) {
            run->checkTokens();
            run->rescan();
        }
    });
    ServeRunOptions run_options = runOptions(options);
    run_options.server.gate = secrets.gate;
    run_options.server.admin_gate = secrets.admin_gate;
    run_options.server.tls = secrets.tls;
    run_options.losses = std::make_shared<DeviceLosses>(options.pipeline_cache.folder);
    run_options.server.reconnect_url = options.advertise;
    run_options.on_failure = [&](const Error& error) {
        failure.put(error);
        stop.request();
    };
    run_options.server.on_drain_request = [&stop] { stop.request(); };
    run.emplace(std::move(run_options));
    printAddresses(options, *run);

    return serveUntilEnd(run, stop, failure, milliseconds(options.drain_s));
}

} // namespace froxel::app

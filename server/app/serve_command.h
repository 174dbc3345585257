// `froxel serve`: puts the rooms together, runs until a signal, and drains.
#pragma once

#include "app/memory_limits.h"
#include "app/scene_source.h"
#include "app/setting_options.h"
#include "gpu/device_options.h"
#include "net/bind_address.h"
#include "session/session_context.h"
#include "settings/settings.h"
#include "stream/jpeg_place.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::app {

// kAuto: where they come from this computer alone, or tokens say who may.
enum class UploadsFrom : uint8_t { kOff, kAuto, kOn };
inline constexpr std::array<std::string_view, 3> kUploadsNames = {"off", "auto", "on"};

// Scenes that clients bring and that stay for a while (guest::StoreLimits).
struct UploadOptions {
    UploadsFrom from = UploadsFrom::kAuto;
    std::filesystem::path folder; // empty: beside the shaders' cache
    uint32_t file_mib = 512;
    uint32_t all_mib = 5 * 1024;
    uint32_t kept_hours = 24;
};

struct ServeOptions {
    std::filesystem::path config;              // where others came from; read when options are
    std::string address = "127.0.0.1";         // IPv4 or IPv6, no host names
    uint16_t port = 8080;                      // 0: any free one; the printed URL tells which
    net::BindAddress admin{"127.0.0.1", 9090}; // for operators; an empty address: nowhere
    std::string scene = "builtin";             // as for loadScene()
    SceneChoices choices;
    bake::Sandbox sandbox = bake::Sandbox::kBest;
    std::filesystem::path scenes;           // a folder of others; empty: there are none
    std::filesystem::path environment_file; // of light from around; empty: none
    bool detail_levels = false;             // render::SceneOptions
    gpu::DeviceChoice device = gpu::DeviceChoice::kAuto;
    bool validation = false;
    gpu::PipelineCacheOptions pipeline_cache;
    uint32_t sessions_max = 16;      // at once, a room being one; more are refused
    uint32_t connections_max = 4096; // of any kind; more are told to come back
    MemoryOptions memory;            // of all sessions and each; absent: memory_limits.h
    // That active sessions must keep when another one joins; absent: by the device's kind.
    std::optional<double> min_rate_hz;
    double frame_limit_s = 1; // of the device's time, that one picture may take by its estimate
    stream::JpegPlace jpeg_encoder = stream::JpegPlace::kAuto;
    double resume_grace_s = 10; // how long a lost connection's session waits for it; 0: not at all
    // net::LobbyRules; absent: half of sessions_max.
    std::optional<uint32_t> sessions_per_address;
    uint32_t sessions_per_token = 0;
    uint32_t viewers_per_room = 256;
    uint32_t stills_per_minute = 600; // still::StillLimits
    uint32_t body_mib = 64;
    UploadOptions uploads;
    double paused_s = 30;
    double idle_s = 300;
    double forget_s = 3600;
    double control_idle_s = 60;
    double drain_s = 5;    // from SIGTERM to the end, for viewers to go elsewhere
    std::string advertise; // URL of the WebSocket where they go; empty: the same address
    // The process ends when the render thread has been at one step for so long; 0: never; absent:
    // by the device's kind.
    std::optional<double> watchdog_s;
    // What a viewer gets before asking for anything; absent: session::defaultsFor(the device).
    std::optional<settings::Size> size;
    std::optional<uint32_t> quality; // settings::kQualityRange
    session::DeliverySettings delivery =
        session::defaultsFor(session::DeviceKind::kCpu).delivery; // the same on both
    settings::ViewSettings first_view; // but for its camera, and its size where that is given above
    GivenSettings given; // of first_view; what was not goes by the scene, as firstLook()
    ChosenLook look;
    std::filesystem::path light_set; // that first_view.lights.placed was read from; empty: none
    std::optional<glm::dvec2> lens_shift;
    // The built page. Empty: web/ beside the binary, else where this build made it.
    std::filesystem::path web_root;
    // Origins ("https://example.org") that may connect besides the server's own.
    std::vector<std::string> allowed_origins;
    std::vector<std::string> host_names;      // answered to, see net::HostNames
    std::vector<std::string> trusted_proxies; // networks, as net::TrustedProxies
    bool agones = false;                      // its SDK on this host is told how the server is
    bool no_depth = false;                    // pictures come without, whoever asks
    std::filesystem::path token_file;         // one of its tokens is asked for; empty: none
    std::filesystem::path
        admin_token_file; // one of its tokens is asked for by POST at the admin address
    std::filesystem::path tls_certificate; // PEM, with its chain; with a key: TLS
    std::filesystem::path tls_key;
};

// By the device's kind: far longer than a piece of a frame takes, with the pipelines that it needs,
// and shorter than the device's wait (gpu/command_context).
inline constexpr double kCpuWatchdog_s = 60;
inline constexpr double kGpuWatchdog_s = 20;

// Prints its URL, and on a second line that of its metrics, to stdout once it listens; logs to
// stderr. Blocks until SIGTERM, SIGINT or POST /drain has drained every session and returns 0; a
// second signal ends the process at once. Ends it with kExitDeviceLost when the device was lost
// while serving or the render thread did not come back. Throws StartupError: kAddressInUse, kIo
// (address, page), kScene, kDevice.
[[nodiscard]] int runServe(const ServeOptions& options);

} // namespace froxel::app

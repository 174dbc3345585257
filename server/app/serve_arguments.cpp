#include "app/serve_arguments.h"

#include "app/bind_option.h"
#include "core/text.h"
#include "net/client_address.h"
#include "net/host_names.h"
#include "net/origin.h"

namespace froxel::app {
namespace {

constexpr settings::Range<uint32_t> kSessionsRange{"max_sessions", 1, 1000};
constexpr settings::Range<uint32_t> kSessionMemoryRange{"session_memory", 16, 1U << 20U};
constexpr settings::Range<uint32_t> kDeviceMemoryRange{"device_memory", 16, 1U << 24U};
constexpr settings::Range<double> kMinRateRange{"min_fps", 0.0, 1000.0};
constexpr settings::Range<double> kFrameLimitRange{"frame_limit", 0.01, 60.0};
constexpr settings::Range<double> kGraceRange{"resume_grace", 0.0, 3600.0};
constexpr settings::Range<uint32_t> kRoomRange{"max_viewers_per_room", 0, 100'000};
constexpr settings::Range<uint32_t> kAccountRange{"max_sessions_per_address", 0, 1000};
constexpr settings::Range<uint32_t> kStillsRange{"max_stills_per_minute", 0, 1'000'000};
constexpr settings::Range<uint32_t> kBodyRange{"max_body", 0, 4096};
constexpr settings::Range<uint32_t> kUploadRange{"max_upload", 1, 1'000'000};
constexpr settings::Range<uint32_t> kUploadSpaceRange{"upload_space", 1, 100'000'000};
constexpr settings::Range<uint32_t> kUploadHoursRange{"upload_hours", 1, 87'600};
constexpr settings::Range<double> kRestRange{"paused_seconds", 0.0, 1e6};
constexpr settings::Range<uint32_t> kConnectionsRange{"max_connections", 1, 1'000'000};
constexpr settings::Range<double> kDrainRange{"drain_seconds", 0.0, 86'400.0};
constexpr settings::Range<double> kWatchdogRange{"watchdog_seconds", 0.0, 86'400.0};

// Whatever follows the scheme is the viewers' matter.
Result<std::string> parseAdvertise(const std::string& text) {
    if (text == "none") {
        return std::string();
    }
    for (const std::string_view scheme : {"ws://", "wss://"}) {
        if (text.compare(0, scheme.size(), scheme) == 0 && text.size() > scheme.size() &&
            text.find_first_of(" ;,\"'\\") == std::string::npos) {
            return text;
        }
    }
    return Error{
        ErrorCode::kInvalidArgument,
        fmt::format("'{}' is neither none nor a WebSocket URL, such as wss://host/ws", text)};
}

// Who gets in, and to what.
void addAccess(CommandBuilder& command, ServeOptions& options) {
    command.neverEmpty(
        command.text("--token-file", "FILE", options.token_file, "",
                     "File of tokens, one in each line; only viewers who send one get in. SIGHUP "
                     "reads it again and disconnects viewers whose token is gone"));
    command.neverEmpty(command.text("--admin-token-file", "FILE", options.admin_token_file, "",
                                    "File of bearer tokens for POST requests at the admin address; "
                                    "required beyond loopback. SIGHUP reads it again"));
    command.neverEmpty(
        command.text("--tls-cert", "FILE", options.tls_certificate, "",
                     "PEM certificate with its chain, for https and wss; SIGHUP reads it again"));
    command.neverEmpty(
        command.text("--tls-key", "FILE", options.tls_key, "", "Key of the certificate, PEM"));
    command.cli().add_flag("--no-depth", options.no_depth,
                           "Send no depth with pictures. Depth lets pages show camera movements at "
                           "once, and shows clients the shape of what they see");
}

void addStillLimits(CommandBuilder& command, ServeOptions& options) {
    command.number("--max-stills-per-minute", options.stills_per_minute, kStillsRange,
                   "Maximum number of /render pictures drawn for one token or address; 127.0.0.1 "
                   "and ::1 are exempt; 0: no limit");
    command.number("--max-body", options.body_mib, kBodyRange,
                   "MiB of the largest scene that POST /render accepts; 0: it accepts none");
}

void addUploads(CommandBuilder& command, UploadOptions& uploads) {
    command.name("--uploads", uploads.from, kUploadsNames,
                 "Whether clients may upload scenes. auto: if the server listens on loopback or "
                 "asks for tokens");
    command.text("--upload-folder", "DIR", uploads.folder, "uploads/ in the shader cache",
                 "Where uploads are kept");
    command.number("--max-upload", uploads.file_mib, kUploadRange,
                   "MiB of the largest file of an upload");
    command.number("--upload-space", uploads.all_mib, kUploadSpaceRange,
                   "MiB of all uploads together; those unused for longest leave first. A tenth of "
                   "the disk stays free");
    command.number("--upload-hours", uploads.kept_hours, kUploadHoursRange,
                   "Hours after its last use at which an upload is deleted");
}

} // namespace

void addServeAddresses(CommandBuilder& command, ServeOptions& options) {
    command.neverEmpty(command.text(
        "--config", "FILE", options.config, "",
        "TOML file with options by their long names, such as max-sessions = 8. Each option is also "
        "an environment variable, such as FROXEL_MAX_SESSIONS. The command line overrides the "
        "environment, and the environment overrides the file"));
    command.neverEmpty(command.text("--address", "IP", options.address, options.address,
                                    "IPv4 or IPv6 to listen on"));
    command.number("--port", options.port, kPortRange, "TCP port, 0 for any free one");
    command.value("--admin-bind", "IP:PORT|none", options.admin, parseBindAddress,
                  fmt::format("{}:{}", options.admin.address, options.admin.port),
                  "Address of /metrics, /livez, /readyz, /startupz and /drain, for operators");
    command.text("--web-root", "DIR", options.web_root, "web beside the binary, else the build's",
                 "Folder of the built page");
    command
        .text("--allow-origin", "ORIGIN", options.allowed_origins, "",
              "Another site whose pages may connect, such as https://example.org; repeatable")
        ->allow_extra_args(false)
        ->check([](const std::string& origin) {
            return net::isOrigin(origin) ? std::string()
                                         : "'" + printable(origin) +
                                               "' is not an origin, such as https://example.org";
        });
    command
        .text("--trusted-proxies", "NETWORK", options.trusted_proxies, "",
              "Proxies whose X-Forwarded-For header gives the viewer's address, such as "
              "10.0.0.0/8; comma-separated, or repeatable")
        ->allow_extra_args(false)
        ->delimiter(',')
        ->check([](const std::string& network) {
            const auto parsed = net::TrustedProxies::parse({network});
            return parsed ? std::string() : parsed.error().message;
        });
    command
        .text("--allow-host", "NAME", options.host_names, "",
              "Host name that requests may use, besides localhost and IP addresses; repeatable. "
              "Default: any name, but no name at a loopback address")
        ->allow_extra_args(false)
        ->check([](const std::string& text) {
            return net::isHostName(text)
                       ? std::string()
                       : fmt::format("'{}' is not a plain host name, such as froxel.example.org",
                                     text);
        });
    command.cli().add_flag("--agones", options.agones,
                           "Report readiness, health, sessions and shutdown to Agones' SDK at port "
                           "$AGONES_SDK_HTTP_PORT of this host (9358 by default)");
    addAccess(command, options);
}

void addServeLimits(CommandBuilder& command, ServeOptions& options) {
    using Defaults = session::SessionDefaults;
    command.number("--max-sessions", options.sessions_max, kSessionsRange,
                   "Maximum number of sessions; all viewers of a room share one");
    command.number("--session-memory", options.memory.session_mib, kSessionMemoryRange,
                   fmt::format("{} on a CPU device, {} on a GPU", kCpuSessionMemory_mib,
                               kGpuSessionMemory_mib),
                   "MiB for the pictures of one session; larger pictures are refused");
    command.number("--device-memory", options.memory.device_mib, kDeviceMemoryRange,
                   fmt::format("{} of the host's or its container's on a CPU device, {} of a GPU's",
                               kHostMemoryShare, kGpuMemoryShare),
                   "MiB for all scenes and sessions together");
    command.number(
        "--scene-memory", options.memory.scene_mib, kDeviceMemoryRange,
        fmt::format("{} of --device-memory", kSceneMemoryShare),
        "MiB of --device-memory for all scenes but the first; unused scenes leave first");
    command.number(
        "--min-fps", options.min_rate_hz, kMinRateRange,
        byDevice([](const Defaults& d) { return fmt::format("{}", d.min_rate_hz); }),
        "Refuse a session that would push active ones below this frame rate; 0: refuse none");
    command.number("--frame-limit", options.frame_limit_s, kFrameLimitRange,
                   "Seconds of device time that one picture may take, as estimated; longer ones "
                   "are drawn smaller");
    command.number("--resume-grace", options.resume_grace_s, kGraceRange,
                   "Seconds that a session waits for its lost viewer");
    command.number("--max-sessions-per-address", options.sessions_per_address, kAccountRange,
                   "half of --max-sessions",
                   "Maximum number of sessions of one address (IPv6: a /64); 127.0.0.1 and ::1 are "
                   "exempt; 0: no limit");
    command.number("--max-sessions-per-token", options.sessions_per_token, kAccountRange,
                   "Maximum number of sessions of one token; 0: no limit");
    command.number("--max-viewers-per-room", options.viewers_per_room, kRoomRange,
                   "Maximum number of viewers of one room, and half as many from one address "
                   "(IPv6: a /64); 127.0.0.1 and ::1 are exempt; 0: no limit");
    command.number("--paused-seconds", options.paused_s, kRestRange,
                   "Seconds after which a session gives its place to a newcomer, if all its "
                   "viewers are paused or acknowledge no frames");
    command.number("--idle-seconds", options.idle_s, kRestRange,
                   "Seconds after which a session gives its place to a newcomer, if its viewers do "
                   "nothing and the picture is static");
    command.number("--forget-seconds", options.forget_s, kRestRange,
                   "Seconds after which such an idle session ends in any case; 0: never");
    command.number(
        "--control-idle-seconds", options.control_idle_s, kRestRange,
        "Seconds after which unused control of a room goes to a viewer who asks; 0: never");
    command.number("--max-connections", options.connections_max, kConnectionsRange,
                   "Maximum number of connections of any kind");
    command.number(
        "--drain-seconds", options.drain_s, kDrainRange,
        "Seconds from SIGTERM or POST /drain to the end, in which viewers move elsewhere");
    command.value(
        "--advertise", "URL|none", options.advertise, parseAdvertise, "none",
        "WebSocket URL that viewers of a draining server move to; none: this address again");
    command.number("--watchdog-seconds", options.watchdog_s, kWatchdogRange,
                   fmt::format("{} on a CPU device, {} on a GPU", kCpuWatchdog_s, kGpuWatchdog_s),
                   "Seconds of stalled drawing after which the process ends; 0: never");
    addStillLimits(command, options);
    addUploads(command, options.uploads);
}

} // namespace froxel::app

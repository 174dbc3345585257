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
    return Error{ErrorCode::kInvalidArgument,
                 fmt::format("'{}' is not none or a WebSocket's URL, such as wss://host/ws", text)};
}

} // namespace

void addServeAddresses(CommandBuilder& command, ServeOptions& options) {
    command.neverEmpty(command.text(
        "--config", "FILE", options.config, "",
        "TOML file of options by their long names, such as max-sessions = 8. Each is also a "
        "variable, FROXEL_MAX_SESSIONS. The command line wins over the environment, that "
        "over the file"));
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
            return net::isOrigin(origin)
                       ? std::string()
                       : "'" + printable(origin) + "' is no origin, such as https://example.org";
        });
    command
        .text("--trusted-proxies", "NETWORK", options.trusted_proxies, "",
              "Proxies whose X-Forwarded-For says from where a viewer comes, such as 10.0.0.0/8; "
              "several with commas, or repeatable")
        ->allow_extra_args(false)
        ->delimiter(',')
        ->check([](const std::string& network) {
            const auto parsed = net::TrustedProxies::parse({network});
            return parsed ? std::string() : parsed.error().message;
        });
    command
        .text("--allow-host", "NAME", options.host_names, "",
              "Name that requests may be addressed to, besides localhost and IP addresses; "
              "repeatable. Without: any, but at a loopback address none")
        ->allow_extra_args(false)
        ->check([](const std::string& text) {
            return net::isHostName(text)
                       ? std::string()
                       : fmt::format("'{}' is not a host's name alone, such as froxel.example.org",
                                     text);
        });
    command.neverEmpty(command.text(
        "--token-file", "FILE", options.token_file, "",
        "Lets in who sends one of its tokens, one a line; read again on SIGHUP, and who has "
        "none of them any more is sent away"));
    command.neverEmpty(
        command.text("--admin-token-file", "FILE", options.admin_token_file, "",
                     "A POST at the admin address must show one of its tokens as a bearer; beyond "
                     "loopback none is answered without. Read again on SIGHUP"));
    command.neverEmpty(
        command.text("--tls-cert", "FILE", options.tls_certificate, "",
                     "Certificate with its chain, PEM, for https and wss; read again on SIGHUP"));
    command.neverEmpty(command.text("--tls-key", "FILE", options.tls_key, "", "Its key, PEM"));
    command.cli().add_flag("--agones", options.agones,
                           "Tell Agones' SDK at $AGONES_SDK_HTTP_PORT of this host, 9358 by "
                           "default, of readiness, health, sessions and the end");
}

void addServeLimits(CommandBuilder& command, ServeOptions& options) {
    using Defaults = session::SessionDefaults;
    command.number("--max-sessions", options.sessions_max, kSessionsRange,
                   "Sessions at once; all viewers of a room share one");
    command.number("--session-memory", options.memory.session_mib, kSessionMemoryRange,
                   fmt::format("{} on a CPU device, {} on a GPU", kCpuSessionMemory_mib,
                               kGpuSessionMemory_mib),
                   "MiB that a session's pictures may take; larger ones are refused");
    command.number("--device-memory", options.memory.device_mib, kDeviceMemoryRange,
                   fmt::format("{} of the host's or its container's on a CPU device, {} of a GPU's",
                               kHostMemoryShare, kGpuMemoryShare),
                   "MiB that the scenes and all sessions may take");
    command.number("--scene-memory", options.memory.scene_mib, kDeviceMemoryRange,
                   fmt::format("{} of --device-memory", kSceneMemoryShare),
                   "MiB of it that scenes of --scenes may take together; those that nobody looks "
                   "at leave for others");
    command.number(
        "--min-fps", options.min_rate_hz, kMinRateRange,
        byDevice([](const Defaults& d) { return fmt::format("{}", d.min_rate_hz); }),
        "Refuse a session that would take active ones below these frames a second; 0: none");
    command.number("--frame-limit", options.frame_limit_s, kFrameLimitRange,
                   "Seconds of the device's time that one picture may take by its estimate; "
                   "longer ones are drawn smaller");
    command.number("--resume-grace", options.resume_grace_s, kGraceRange,
                   "Seconds that a lost connection's session waits for it");
    command.number("--max-sessions-per-address", options.sessions_per_address, kAccountRange,
                   "half of --max-sessions",
                   "Sessions opened from one address (IPv6: a /64), which 127.0.0.1 and ::1 are "
                   "exempt from; 0: no matter");
    command.number("--max-sessions-per-token", options.sessions_per_token, kAccountRange,
                   "Sessions opened with one token; 0: no matter");
    command.number("--max-viewers-per-room", options.viewers_per_room, kRoomRange,
                   "Viewers of one room, half of them from one address (IPv6: a /64), which "
                   "127.0.0.1 and ::1 are exempt from; 0: no matter");
    command.number("--max-stills-per-minute", options.stills_per_minute, kStillsRange,
                   "Pictures of /render that one token or address may have drawn, which 127.0.0.1 "
                   "and ::1 are exempt from; 0: no matter");
    command.number("--paused-seconds", options.paused_s, kRestRange,
                   "A session whose viewers are all paused, or take no pictures, for so long ends "
                   "when another needs its place");
    command.number("--idle-seconds", options.idle_s, kRestRange,
                   "The same where they do nothing and their picture stands");
    command.number("--forget-seconds", options.forget_s, kRestRange,
                   "A session that rests in either way for so long ends anyway; 0: never");
    command.number("--control-idle-seconds", options.control_idle_s, kRestRange,
                   "Control of a room that is not used for so long goes to who asks; 0: never");
    command.number("--max-connections", options.connections_max, kConnectionsRange,
                   "Connections of any kind at once");
    command.number("--drain-seconds", options.drain_s, kDrainRange,
                   "From SIGTERM or POST /drain to the end, for viewers to go elsewhere");
    command.value("--advertise", "URL|none", options.advertise, parseAdvertise, "none",
                  "WebSocket that viewers are sent to meanwhile; none: this address again");
    command.number("--watchdog-seconds", options.watchdog_s, kWatchdogRange,
                   fmt::format("{} on a CPU device, {} on a GPU", kCpuWatchdog_s, kGpuWatchdog_s),
                   "End the process when drawing has stood still for so long; 0: never");
}

} // namespace froxel::app

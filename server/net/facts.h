// What proxies, manifests and probes must know of a server; `froxel info --json` says it, too.
#pragma once

#include <chrono>
#include <string_view>

namespace froxel::net {

// Of the viewers' address.
inline constexpr std::string_view kSocketPath = "/ws";
// The same for a viewer of a room, for proxies that tell requests apart by their path alone.
inline constexpr std::string_view kRoomSocketPath = "/rooms/ws";
constexpr bool isSocketPath(std::string_view path) {
    return path == kSocketPath || path == kRoomSocketPath;
}
// Of the admin address.
inline constexpr std::string_view kMetricsPath = "/metrics";
inline constexpr std::string_view kLivePath = "/livez";
inline constexpr std::string_view kReadyPath = "/readyz";
inline constexpr std::string_view kStartedPath = "/startupz";
inline constexpr std::string_view kDrainPath = "/drain";
inline constexpr std::string_view kRoomsPath = "/rooms/";

// What a Fleet of Agones must have: a counter of this name, and patience for pings as far apart.
inline constexpr std::string_view kAgonesCounter = "sessions";
inline constexpr std::chrono::seconds kAgonesHealthPeriod{2};

// Silence of this length ends a WebSocket; a ping goes out at half of it.
inline constexpr std::chrono::seconds kIdleTimeout{20};

} // namespace froxel::net

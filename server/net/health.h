// What probes are told of a server: each an answer of yes, or no with why in one line. Any thread.
#pragma once

#include "net/service.h"

#include <functional>

namespace froxel::net {

// A step of the render thread that takes longer than this makes a server unready: frames do not.
inline constexpr Seconds kUnreadyStep{10};

// Whether the scene is there: from then on for good.
[[nodiscard]] Result<void> hasStarted(const ServiceStatus& status);
// Whether it serves. Being full is no part of it: a proxy would take the server from its viewers,
// who then could not come back to it.
[[nodiscard]] Result<void> isReady(const ServiceStatus& status, TimePoint now);
// Whether the process moves at all. `network_moves` may wait, and is asked while connections live.
[[nodiscard]] Result<void>
isLive(const ServiceStatus& status, const std::function<bool()>& network_moves, TimePoint now);
// Whether the render thread still moves, as far as its limit tells.
[[nodiscard]] Result<void> rendersOn(const ServiceStatus& status, TimePoint now);

} // namespace froxel::net

// Who gets a place, and who keeps it.
#pragma once

#include "core/clock.h"

#include <chrono>
#include <cstdint>

namespace froxel::net {

// How long a viewer counts as watching.
struct RestLimits {
    Seconds paused{30}; // after it paused, or stopped acknowledging the pictures that it gets
    Seconds idle{300};  // after its last command, or its last picture
};

// How many are let in, and for how long. A number of 0 is no limit, a time of 0 s never.
struct LobbyRules {
    std::chrono::milliseconds resume_grace{0}; // that a lost connection's place is kept; 0: not
    uint32_t sessions_max = 0;                 // a room being one
    uint32_t sessions_per_address = 0;         // opened from there; not of Caller::local
    uint32_t sessions_per_token = 0;
    uint32_t viewers_per_room = 0;
    uint32_t viewers_per_room_and_address = 0; // not of Caller::local
    // Whose viewers do not count as watching any more gives its place to who would be refused ...
    RestLimits rest{};
    // ... and ends by itself so long after their last sign of it.
    Seconds forget{3600};
    Seconds control_idle{60}; // as LiveSession::passIdleControl
};

} // namespace froxel::net

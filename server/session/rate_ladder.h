// The steps that a slow link leads down: fewer bits a frame (quality, then chroma; of video its
// rate), then fewer pixels, then fewer frames. Pure.
#pragma once

#include "session/delivery.h"

#include <vector>

namespace froxel::session {

struct Rung {
    Delivery delivery;  // rung is its place in the ladder
    double bits = 1;    // of a frame, against the first rung's; an estimate
    bool alone = false; // a frame leaves when the one before is there: nothing waits on the link
};

// From what was asked for downwards; the first changes nothing. Rungs that would change nothing
// for this encoding are not there.
[[nodiscard]] std::vector<Rung> makeLadder(const settings::Encoding& asked);

} // namespace froxel::session

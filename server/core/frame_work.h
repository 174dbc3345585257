// The work that a frame will cause on the device, known when it begins. A plain value.
#pragma once

#include "core/clock.h"

#include <cstdint>

namespace froxel {

struct FrameWork {
    Seconds estimate{0};    // device time of all its pieces; 0: unknown
    double limit_share = 0; // of the longest that a frame may take
    // 0: the frame cannot begin yet; ask again.
    uint32_t piece_count = 1;
    // The reason for 0. True: the host works on the frame in stages, and continues with the next
    // begin() for the same inputs. False: shader variants are being compiled.
    bool half_built = false;
};

} // namespace froxel

// A picture before exposure and tone map.
#pragma once

#include <cstdint>
#include <vector>

namespace froxel {

// Linear fp32 radiance: [height][width][3], top row first.
struct LinearImage {
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    std::vector<float> rgb;
};

} // namespace froxel

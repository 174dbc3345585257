// The studio's surroundings, filtered when Froxel is built: at run time that takes 1.2 s of two
// cores, of the 1.9 s that a first picture takes.
#pragma once

#include "environment/prefiltered.h"

#include <cstdint>
#include <span>

namespace froxel::environment {

// Of the panorama that it is made of: as fine as the finest level.
inline constexpr uint32_t kStudioWidth_px = 4 * PrefilterSize{}.finest_px;

// Each level's texels are as CubeLevel has them, of one channel: the studio is white.
struct StudioTable {
    std::span<const double> roughness; // of each level, the finest first
    std::span<const float> texels;     // one level after another
    std::span<const double> matt;      // Diffuse::terms, of one channel
};
[[nodiscard]] StudioTable studioTable();

} // namespace froxel::environment

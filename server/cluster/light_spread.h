// How a frame's lights are spread, in a few numbers: what a grid is chosen by.
#pragma once

#include "cluster/cluster_grid.h"
#include "light/frame_lights.h"

#include <cstdint>
#include <vector>

namespace froxel::cluster {

struct LightSpread {
    uint32_t light_count = 0;
    double unlimited_share = 0; // lights without a range limit: in every list
    // Moments of the other radii, metres: means of r, r^2 and r^3.
    double radius1_m = 0;
    double radius2_m2 = 0;
    double radius3_m3 = 0;
    // Of a block as large as the lights' spread, by the covariance of their positions, and, so that
    // lights in one plane do not make it vanish, half a ball larger on every axis. Cubic metres.
    double volume_m3 = 0;
    // Depths of lights that reach the picture, evenly drawn from all of them, and for how many
    // lights each of them stands.
    std::vector<double> seen_depths_m;
    double lights_per_depth = 0;
};

// Looks at kSpreadSamples lights at most, evenly drawn: microseconds for any number of lights.
inline constexpr size_t kSpreadSamples = 1024;
[[nodiscard]] LightSpread lightSpread(const ClusterGrid& grid, const light::FrameLights& lights);

} // namespace froxel::cluster

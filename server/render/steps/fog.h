// Fog: the picture is seen through a medium, in which lights are scattered in a froxel volume.
#pragma once

#include <cstdint>

namespace froxel::render {

// Of StepPlan::way.
inline constexpr uint32_t kFogVolume = 1U << 0U; // lights are scattered
inline constexpr uint32_t kFogNoise = 1U << 1U;  // at jittered places

} // namespace froxel::render

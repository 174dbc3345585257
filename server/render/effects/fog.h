// Fog: the picture is seen through a medium, in which lights are scattered in a froxel volume.
#pragma once

#include "render/frame/effect_plan.h"

namespace froxel::render {

// Of EffectPlan::way.
inline constexpr uint32_t kFogVolume = 1U << 0U; // lights are scattered
inline constexpr uint32_t kFogNoise = 1U << 1U;  // at jittered places

extern const EffectRow kFogEffect;

} // namespace froxel::render

// Shadow maps: depths as lights see them, in one atlas, where whatever is lit looks them up. Drawn
// by the depth prepass's own pipelines.
#pragma once

#include "render/effects/effect_plan.h"
#include "render/shadow_atlas.h"

namespace froxel::render {

// Of EffectPlan::way: the frame draws maps. Else it keeps the atlas for when a light with maps
// comes back into view.
inline constexpr uint32_t kShadowsDrawn = 1U << 0U;

extern const EffectRow kShadowsEffect;

// A copy of the atlas as the last frame of this effect, which drew maps, left it. Waits; throws
// vk::SystemError.
[[nodiscard]] ShadowAtlas copyShadows(const Effect& shadows);

} // namespace froxel::render

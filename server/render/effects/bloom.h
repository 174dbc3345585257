// Bloom: bright light of the linear picture is spread over it.
#pragma once

#include "render/frame/effect_plan.h"

namespace froxel::render {

// EffectPlan::way is a settings::BloomKind.
extern const EffectRow kBloomEffect;

} // namespace froxel::render

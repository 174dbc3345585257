// What is around shows behind the scene: a pass over the pixels that no surface covers, before
// anything is blended with them.
#pragma once

#include "render/frame/effect_plan.h"

namespace froxel::render {

// Of frames that have the environment, too, which is what it shows.
extern const EffectRow kBackgroundEffect;

} // namespace froxel::render

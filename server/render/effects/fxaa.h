// The antialiasing filter over the finished picture: from the picture before it to where pixels are
// copied from or read.
#pragma once

#include "render/frame/effect_plan.h"

namespace froxel::render {

extern const EffectRow kFxaaEffect;

} // namespace froxel::render

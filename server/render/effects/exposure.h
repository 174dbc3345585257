// Exposure metered by the frame itself: a histogram of its luminance, and what that comes to in the
// frame's own uniforms, where all that shows the picture finds it. The host never waits for it, and
// no frame depends on another.
#pragma once

#include "render/frame/effect_plan.h"

namespace froxel::render {

extern const EffectRow kExposureEffect;

} // namespace froxel::render

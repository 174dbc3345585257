// Metered exposure as it is meant, in double: without a histogram's bins.
#pragma once

#include "core/linear_image.h"
#include "core/visibility.h"
#include "scene/scene.h"

namespace froxel::reference {

// What brings the geometric mean of the middle pixels' luminance (BT.709) to 0.18, at most ten
// stops up or down. Of the pixels whose solid surface is lit by any light, those are left out that
// are darker than 2^-16, and then a tenth at either end; what is brighter than 2^16 counts as that.
// 1 where no pixel is left. Unlit surfaces behind blended ones are left out here, but not by a
// device. `picture` and `visibility` are of one size, and of `scene`.
[[nodiscard]] double
meteredFactor(const scene::Scene& scene, const LinearImage& picture, const Visibility& visibility);

} // namespace froxel::reference

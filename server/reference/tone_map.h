// What the display emits of a radiance, in double.
#pragma once

#include "core/math.h"
#include "settings/settings.h"

namespace froxel::reference {

// Exposed, then tone mapped: Khronos PBR Neutral (Khronos 2024) or a clamp. Linear; the latter's
// channels may exceed 1, and those of NaN are NaN.
[[nodiscard]] glm::dvec3
toneMapped(const glm::dvec3& radiance, double exposure, settings::ToneMap tone_map);

} // namespace froxel::reference

// What the display emits of a radiance, in double.
#pragma once

#include "core/math.h"
#include "settings/settings.h"

namespace froxel::reference {

// Exposed, then tone mapped: Khronos PBR Neutral (Khronos 2024) or a clamp. Linear; the latter's
// channels may exceed 1, and those of NaN are NaN.
[[nodiscard]] glm::dvec3
toneMapped(const glm::dvec3& radiance, double exposure, settings::ToneMap tone_map);

// The radiance that the display shows as this colour of it, 0 to 1; of the neutral tone map, which
// takes only infinity to white, at most as of 0.95.
[[nodiscard]] glm::dvec3
shownAs(const glm::dvec3& color, double exposure, settings::ToneMap tone_map);

} // namespace froxel::reference

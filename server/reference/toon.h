// The toon ramps, from their points, and bands of light.
#pragma once

#include "settings/settings.h"

namespace froxel::reference {

// Cubic Hermite interpolation between the points around x; constant outside them.
[[nodiscard]] double toonRamp(const settings::ToonRamp& ramp, double x);

// The middle of the band that `light` lies in, out of `bands` of equal width in
// sqrt(light / (light + middle)), or in sqrt(light) where middle is 0: then light is a share, of
// which 1 stays 1. 0 for 0. No bands: light itself.
[[nodiscard]] double toonBand(uint32_t bands, double light, double middle);

// A highlight of a surface of this alpha (roughness^2), as a multiple of what a white surface
// scatters: half of the height that GGX has head-on, within 1 to 25.
[[nodiscard]] double toonGloss(double alpha);

} // namespace froxel::reference

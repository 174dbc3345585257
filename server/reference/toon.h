// The toon ramps, from their points.
#pragma once

#include "settings/settings.h"

namespace froxel::reference {

// Cubic Hermite interpolation between the points around x; constant outside them.
[[nodiscard]] double toonRamp(const settings::ToonRamp& ramp, double x);

} // namespace froxel::reference

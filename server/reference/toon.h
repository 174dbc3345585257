// The toon ramps, from their points.
#pragma once

#include "view/settings.h"

namespace froxel::reference {

// Cubic Hermite interpolation between the points around x; constant outside them.
[[nodiscard]] double toonRamp(const view::ToonRamp& ramp, double x);

} // namespace froxel::reference

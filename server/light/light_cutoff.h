// Lights that end early: error for speed, on purpose.
#pragma once

#include "light/frame_lights.h"

#include <glm/vec3.hpp>

namespace froxel::light {

// Where a light of this colour and radius (metres; infinity: none) has fallen to an irradiance of
// `cutoff` > 0 in its strongest channel: the root of strongest * window(d) / d^2 = cutoff. 0 where
// it is weaker than that everywhere a surface can be (1 cm and beyond).
[[nodiscard]] double cutRadius(const glm::vec3& color, double radius_m, double cutoff);

// Gives every local light its cut radius. Within it a light is windowed anew, so it is darker than
// it was and still ends smoothly.
void cutLights(FrameLights& lights, double cutoff);

} // namespace froxel::light

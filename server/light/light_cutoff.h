// Lights that end early: error for speed, on purpose.
#pragma once

#include "light/frame_lights.h"

#include <glm/vec3.hpp>

namespace froxel::light {

// Where a light of this colour and radius (metres; infinity: none) has fallen to an irradiance of
// `cutoff` > 0 in its strongest channel: the root of strongest * window(d) / d^2 = cutoff. 0 where
// it is weaker than that everywhere it is told from nearer places: from nearest_m on.
[[nodiscard]] double
cutRadius(const glm::vec3& color, double radius_m, double cutoff, double nearest_m);

// Gives every local light its cut radius. Within it a light is windowed anew, so it is darker than
// it was and still ends smoothly.
//
// compensated: a light's colour grows by what it lost. Over points spread evenly in space a light
// adds in the mean what the integral of window(d)^2 / d^2 over its ball is, 4 pi 32/45 radius: the
// colour is multiplied by the radii's ratio. A light without a radius keeps its colour: it loses
// without end.
void cutLights(FrameLights& lights, double cutoff, bool compensated);

} // namespace froxel::light

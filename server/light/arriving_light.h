// How bright the lights of a scene's file are, as an incident-light meter would say.
#pragma once

#include "scene/scene.h"

namespace froxel::light {

// Irradiance at the scene's surfaces from its own lights, in lux if the file follows
// KHR_lights_punctual: the geometric mean over the brighter half, by area, of what gets any. It
// depends on how much light arrives, not on how much of it surfaces send back. Nothing shades
// anything. 0: no surface gets any. Where the scene rests; takes some ms, and no more for many
// lights. Pure.
[[nodiscard]] double arrivingLight(const scene::Scene& scene);

} // namespace froxel::light

// How a scene is lit and exposed of which nobody has said anything.
#pragma once

#include "scene/scene.h"
#include "settings/settings.h"

namespace froxel::scene {

// Changes what has to go by the scene. Seeded lights reach 12 % of the scene's half diagonal,
// rounded to 1, 2 or 5 times a power of ten, with the intensity that gives surfaces at their reach
// as much as at 2 m; both within their ranges. They are off but in Sponza. All other scenes stand
// in the studio, unless all of them is unlit. It is dimmer in rooms, which get a few white lamps,
// and beside a scene's own lights. Nobody knows their units: they are brought to what suits the
// studio, by arriving_lux (light::arrivingLight()), so that what is black looks black and what is
// white looks white.
void lookFor(const Scene& scene, double arriving_lux, settings::ViewSettings& settings);

// Whether it begins with the look "evening".
[[nodiscard]] bool suitsEvening(const Scene& scene);

} // namespace froxel::scene

// How a scene is lit and exposed of which nobody has said anything.
#pragma once

#include "scene/scene.h"
#include "settings/settings.h"

namespace froxel::scene {

// Changes what has to go by the scene. Seeded lights reach 12 % of the scene's half diagonal,
// rounded to 1, 2 or 5 times a power of ten, with the intensity that gives surfaces at their reach
// as much as at 2 m; both within their ranges. They are off but in Sponza. All other scenes stand
// in the studio, unless all of them is unlit. It is dimmer beside a scene's own lights, whose units
// nobody knows and which are exposed by the picture, and in rooms, which get a few white lamps.
void lookFor(const Scene& scene, settings::ViewSettings& settings);

// Whether it begins with the look "evening".
[[nodiscard]] bool suitsEvening(const Scene& scene);

} // namespace froxel::scene

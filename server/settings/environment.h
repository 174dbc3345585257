// What lights a scene besides its lights: linear radiance at strength 1.
#pragma once

#include <glm/glm.hpp>

namespace froxel::settings {

// A hemisphere of constant radiance from above and one from below: a cool dusk, a warm bounce. A
// surface sees (1 + up . normal) / 2 of the first and the rest of the second.
inline constexpr glm::vec3 kAmbientSky{0.050F, 0.058F, 0.075F};
inline constexpr glm::vec3 kAmbientGround{0.030F, 0.026F, 0.022F};

} // namespace froxel::settings

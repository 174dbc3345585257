// The sphere that framing a scene is about.
#pragma once

#include "scene/scene.h"

namespace froxel::scene {

// About the middle of bounds_world, through the vertex farthest from it; settings::Sphere{} where
// the scene has none; without what surrounds all else (Surround). A model fills much less of the
// sphere about its box. Looks at the vertices of those primitives alone whose boxes reach farther
// than what was found. A scene that moves is taken at rest.
[[nodiscard]] settings::Sphere enclosingSphere(const Scene& scene);

} // namespace froxel::scene

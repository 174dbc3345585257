// How many surfaces of a scene lie over one another.
#pragma once

#include "scene/scene.h"

#include <cstdint>

namespace froxel::scene {

// The most triangles that one of 48 lines meets, about: each line goes through the middle of some
// triangle, along its normal. A picture along it draws each of its pixels so often, and nothing
// that a device has begun can be called off. Of a large scene a part of the triangles is looked at,
// chosen anew each time, so that no file is made to hide them: 40 ms, however many there are.
// Deformations are not looked at.
[[nodiscard]] uint64_t stackedLayers(const Scene& scene);

} // namespace froxel::scene

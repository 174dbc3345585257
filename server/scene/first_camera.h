// The view of a scene that nobody has chosen.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace froxel::scene {

// The first of the scene's cameras; with none, one that sees all of it.
[[nodiscard]] inline view::Camera firstCamera(const std::vector<NamedCamera>& cameras,
                                              const BoundsD3& bounds_world) {
    return cameras.empty() ? view::overview(bounds_world) : cameras.front().camera;
}

} // namespace froxel::scene

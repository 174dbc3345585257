// The view of a scene that nobody has chosen.
#pragma once

#include "scene/enclosing_sphere.h"
#include "scene/scene.h"
#include "settings/settings.h"

#include <vector>

namespace froxel::scene {

// The first of the scene's cameras; with none, one that has all of it, of its enclosingSphere(), in
// pictures of a size.
[[nodiscard]] inline settings::Camera firstCamera(const std::vector<NamedCamera>& cameras,
                                                  const settings::Sphere& sphere_world,
                                                  const settings::Size& size) {
    return cameras.empty() ? settings::overview(sphere_world, settings::aspectOf(size))
                           : cameras.front().camera;
}
[[nodiscard]] inline settings::Camera firstCamera(const Scene& scene, const settings::Size& size) {
    return firstCamera(scene.cameras,
                       scene.cameras.empty() ? enclosingSphere(scene) : settings::Sphere{}, size);
}

} // namespace froxel::scene

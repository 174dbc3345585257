// The view of a scene that nobody has chosen.
#pragma once

#include "scene/enclosing_sphere.h"
#include "scene/scene.h"
#include "view/settings.h"

#include <vector>

namespace froxel::scene {

// The first of the scene's cameras; with none, one that has all of it, of its enclosingSphere(), in
// pictures of a size.
[[nodiscard]] inline view::Camera firstCamera(const std::vector<NamedCamera>& cameras,
                                              const view::Sphere& sphere_world,
                                              const view::Size& size) {
    return cameras.empty() ? view::overview(sphere_world, view::aspectOf(size))
                           : cameras.front().camera;
}
[[nodiscard]] inline view::Camera firstCamera(const Scene& scene, const view::Size& size) {
    return firstCamera(scene.cameras,
                       scene.cameras.empty() ? enclosingSphere(scene) : view::Sphere{}, size);
}

} // namespace froxel::scene

// The view of a scene that nobody has chosen.
#pragma once

#include "scene/scene.h"
#include "settings/settings.h"

#include <cstddef>
#include <optional>

namespace froxel::scene {

struct FirstView {
    std::optional<size_t> scene_camera;     // of Scene::cameras: the camera is that one
    std::optional<settings::Camera> camera; // none: all of the sphere, in pictures of any size
    settings::Sphere sphere_world{};
    glm::dvec3 toward_eye = settings::kUsualTowardEye; // from the sphere, of any length
    std::optional<Warning> remark; // why it is not the scene's first camera, or not the usual side

    [[nodiscard]] settings::Camera cameraFor(const settings::Size& size) const;
};

// The first of the scene's cameras that may see anything of it. With none, from within a room, at
// eye height, along the longest free way. Else all of `sphere_world`, from above the front right,
// or from the like corner that most surfaces face if hardly any faces that one. O(triangles) where
// it has no camera; throws nothing.
[[nodiscard]] FirstView firstViewOf(const Scene& scene, const settings::Sphere& sphere_world);

// Whether any triangle that is not culled may be in a picture of any width: some corner of its is
// not beyond the near plane or the upper and lower edge together with the others. What stands
// before it does not count.
[[nodiscard]] bool seesAnything(const Scene& scene, const settings::Camera& camera);

} // namespace froxel::scene

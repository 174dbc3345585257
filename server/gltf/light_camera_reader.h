// Cameras and KHR_lights_punctual lights, placed by a node.
#pragma once

#include "gltf/document.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>

namespace froxel::gltf {

// Unit columns right, up, back of the node; none: a scale of 0 leaves no direction.
using NodeAxes = std::optional<glm::dmat3>;

// Number `index` of the file's, placed at `eye_world`. The far plane is dropped: there is none. The
// name is empty where the file has none. Values out of range are brought to the nearest that makes
// sense, with a warning; where there is none, or no direction, so is the camera.
[[nodiscard]] std::optional<scene::NamedCamera> readCamera(const CameraSource& source,
                                                           size_t index,
                                                           const glm::dvec3& eye_world,
                                                           const NodeAxes& world_from_view,
                                                           Warnings& warnings);

// Likewise; none for a type that is not known.
[[nodiscard]] std::optional<scene::PunctualLight> readLight(const LightSource& source,
                                                            size_t index,
                                                            const glm::dvec3& position_world,
                                                            const NodeAxes& axes_world,
                                                            Warnings& warnings);

} // namespace froxel::gltf

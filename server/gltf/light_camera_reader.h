// Cameras and KHR_lights_punctual lights, placed by a node.
#pragma once

#include "scene/scene.h"

#include <glm/glm.hpp>

#include <string>

namespace tinygltf {
struct Camera;
struct Light;
} // namespace tinygltf

namespace froxel::gltf {

// Position and orientation by the node, whose scale does not count. The far plane is dropped: there
// is none. The name is empty where the file has none. Throws Failure for values out of range.
[[nodiscard]] scene::NamedCamera readCamera(const tinygltf::Camera& camera,
                                            const glm::dmat4& world_from_node,
                                            const std::string& user);

// Throws Failure for an unknown type and values out of range.
[[nodiscard]] scene::PunctualLight
readLight(const tinygltf::Light& light, const glm::dmat4& world_from_node, const std::string& user);

} // namespace froxel::gltf

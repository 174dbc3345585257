// Matrices and vectors of nodes, in double.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <string>

namespace tinygltf {
class Node;
} // namespace tinygltf

namespace froxel::gltf {

// parent_from_node by the node's matrix or translation, rotation and scale. Throws Failure for
// arrays of a wrong length, a matrix that is not affine and a rotation of length 0.
[[nodiscard]] glm::dmat4 nodeTransform(const tinygltf::Node& node, const std::string& name);

// translation * rotation * scale; the rotation is made unit. Throws Failure for one of length 0.
[[nodiscard]] glm::dmat4 composeTransform(const glm::dvec3& translation,
                                          const glm::dquat& rotation,
                                          const glm::dvec3& scale,
                                          const std::string& name);

// Throws Failure where a chain of transforms has left the range of numbers.
void checkFinite(const glm::dmat4& world_from_node, const std::string& name);

} // namespace froxel::gltf

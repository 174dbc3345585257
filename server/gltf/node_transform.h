// Matrices and vectors of nodes, in double.
#pragma once

#include "gltf/warnings.h"
#include "scene/transform.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <string>

namespace tinygltf {
class Node;
} // namespace tinygltf

namespace froxel::gltf {

// parent_from_node by the matrix or translation, rotation and scale of the node, which is `index`
// of the file. Warns of a matrix that shears or is not affine, and of rotations as below.
[[nodiscard]] glm::dmat4
nodeTransform(const tinygltf::Node& node, size_t index, Warnings& warnings);

// The node's translation, rotation and scale, which one with a matrix does not have.
[[nodiscard]] scene::Transform nodeParts(const tinygltf::Node& node);

// The matrix of a node that has one, made affine.
[[nodiscard]] glm::dmat4 nodeMatrix(const tinygltf::Node& node);

// Warns of a rotation whose length is not 1.
void checkRotation(const glm::dquat& rotation,
                   const std::string& pointer,
                   const std::string& name,
                   Warnings& warnings);

// Whether a chain of transforms down to node `index` has stayed within scene::kLargestElement;
// warns where it has not.
[[nodiscard]] bool isUsable(const glm::dmat4& world_from_node, size_t index, Warnings& warnings);

} // namespace froxel::gltf

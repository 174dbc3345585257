// Matrices and vectors of nodes, in double.
#pragma once

#include "gltf/warnings.h"
#include "scene/transform.h"

#include <glm/glm.hpp>

#include <string>

namespace tinygltf {
class Node;
} // namespace tinygltf

namespace froxel::gltf {

// parent_from_node by the matrix or translation, rotation and scale of the node, which is `index`
// of the file. Warns of a matrix that shears and of rotations as below. Throws Failure for arrays
// of a wrong length and a matrix that is not affine.
[[nodiscard]] glm::dmat4
nodeTransform(const tinygltf::Node& node, size_t index, Warnings& warnings);

// The node's translation, rotation and scale, which one with a matrix does not have. Throws Failure
// for arrays of a wrong length.
[[nodiscard]] scene::Transform nodeParts(const tinygltf::Node& node, const std::string& name);

// The matrix of a node that has one. Throws Failure as nodeTransform().
[[nodiscard]] glm::dmat4 nodeMatrix(const tinygltf::Node& node, const std::string& name);

// Warns of a rotation whose length is not 1.
void checkRotation(const glm::dquat& rotation,
                   const std::string& pointer,
                   const std::string& name,
                   Warnings& warnings);

// Throws Failure where a chain of transforms has left scene::kLargestElement.
void checkUsable(const glm::dmat4& world_from_node, const std::string& name);

} // namespace froxel::gltf

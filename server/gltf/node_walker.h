// The nodes that a scene shows, and where they are.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace tinygltf {
class Model;
} // namespace tinygltf

namespace froxel::gltf {

struct PlacedNode {
    size_t node = 0;
    glm::dmat4 world_from_node{1};
};

// Every node of the default scene (else scene 0, else all trees), parents before children, siblings
// in the file's order. Any depth. Throws Failure for a node with two parents, a cycle anywhere in
// the file, an index out of range and a scene that lists a node twice or one with a parent.
[[nodiscard]] std::vector<PlacedNode> placeNodes(const tinygltf::Model& model);

} // namespace froxel::gltf

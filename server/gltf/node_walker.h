// The nodes that a scene shows, and where they are.
#pragma once

#include "gltf/warnings.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace tinygltf {
class Model;
} // namespace tinygltf

namespace froxel::gltf {

struct PlacedNode {
    size_t node = 0;
    std::optional<size_t> parent; // before it among the placed nodes; none: of the world
    glm::dmat4 world_from_node{1};
    bool visible = true; // KHR_node_visibility: with its meshes and lights; cameras always are
};

// Every node of the default scene (else scene 0, else all trees) once, parents before children,
// siblings in the file's order. Any depth. Warns of a node with two parents (it is under the first)
// and of a scene that lists a child: it is placed without those above it, or stays where another
// node of the scene has it. Left out with all below, and a warning, is a node whose transform
// leaves the range of numbers. Throws Failure for a cycle anywhere in the file and for an index out
// of range.
[[nodiscard]] std::vector<PlacedNode> placeNodes(const tinygltf::Model& model, Warnings& warnings);

} // namespace froxel::gltf

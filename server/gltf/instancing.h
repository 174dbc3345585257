// EXT_mesh_gpu_instancing: one node that places its mesh many times.
#pragma once

#include "gltf/accessor_reader.h"
#include "gltf/limits.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace tinygltf {
class Node;
} // namespace tinygltf

namespace froxel::gltf {

// node_from_object of every instance; one identity where the node does not use the extension.
// Takes from `budget` before it allocates. Throws Failure for unequal counts.
[[nodiscard]] std::vector<glm::dmat4> nodeInstances(const tinygltf::Node& node,
                                                    size_t index,
                                                    AccessorReader& accessors,
                                                    Budget& budget,
                                                    Warnings& warnings);

} // namespace froxel::gltf

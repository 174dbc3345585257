// Every triangle topology of glTF as a plain list, and what triangles say about their vertices.
#pragma once

#include "scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace froxel::gltf {

enum class Topology { kTriangles, kStrip, kFan };

// Indices that the list has for `count` indices of the topology; incomplete triangles do not count.
[[nodiscard]] size_t listLength(Topology topology, size_t count);

// Three indices per triangle, all wound as the file winds its first; what is left over after the
// last whole triangle is dropped.
[[nodiscard]] std::vector<uint32_t> triangleList(Topology topology, std::vector<uint32_t> indices);

// A value for each index.
template <class T>
[[nodiscard]] std::vector<T> unshared(const std::vector<T>& stream,
                                      const std::vector<uint32_t>& indices) {
    std::vector<T> corners;
    if (!stream.empty()) {
        corners.reserve(indices.size());
        for (const uint32_t index : indices) {
            corners.push_back(stream[index]);
        }
    }
    return corners;
}

// Gives every corner of every triangle its own vertex with the triangle's normal, as the
// specification asks where a file has no normals. A triangle without area gets +Y.
void makeFlat(scene::Primitive& primitive);

} // namespace froxel::gltf

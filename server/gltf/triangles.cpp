#include "gltf/triangles.h"

#include "gltf/normals.h"

#include <numeric>

namespace froxel::gltf {
size_t listLength(Topology topology, size_t count) {
    if (topology == Topology::kTriangles) {
        return count - count % 3;
    }
    return count < 3 ? 0 : (count - 2) * 3;
}

std::vector<uint32_t> triangleList(Topology topology, std::vector<uint32_t> indices) {
    const size_t length = listLength(topology, indices.size());
    if (topology == Topology::kTriangles) {
        indices.resize(length);
        return indices;
    }
    std::vector<uint32_t> list;
    list.reserve(length);
    for (size_t i = 0; i + 2 < indices.size(); ++i) {
        if (topology == Topology::kStrip) {
            list.insert(list.end(), {indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]});
        } else {
            list.insert(list.end(), {indices[i + 1], indices[i + 2], indices[0]});
        }
    }
    return list;
}

void makeFlat(scene::Primitive& primitive) {
    primitive.positions = unshared(primitive.positions, primitive.indices);
    primitive.uv0 = unshared(primitive.uv0, primitive.indices);
    primitive.uv1 = unshared(primitive.uv1, primitive.indices);
    primitive.colors = unshared(primitive.colors, primitive.indices);
    primitive.tangents.clear();
    std::iota(primitive.indices.begin(), primitive.indices.end(), 0U);
    primitive.normals.resize(primitive.positions.size());
    for (size_t i = 0; i + 2 < primitive.positions.size(); i += 3) {
        const glm::vec3 normal = unitNormal(areaNormal(
            primitive.positions[i], primitive.positions[i + 1], primitive.positions[i + 2]));
        primitive.normals[i] = primitive.normals[i + 1] = primitive.normals[i + 2] = normal;
    }
}

} // namespace froxel::gltf

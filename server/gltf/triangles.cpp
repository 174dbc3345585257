#include "gltf/triangles.h"

#include <numeric>

namespace froxel::gltf {
namespace {

template <class T>
void unshare(std::vector<T>& stream, const std::vector<uint32_t>& indices) {
    if (stream.empty()) {
        return;
    }
    std::vector<T> corners;
    corners.reserve(indices.size());
    for (const uint32_t index : indices) {
        corners.push_back(stream[index]);
    }
    stream = std::move(corners);
}

// In double: the cross product of a large triangle overflows float, of a small one vanishes.
glm::vec3 faceNormal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    return length > 0 ? glm::vec3(normal / length) : glm::vec3(0, 1, 0);
}

} // namespace

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
    unshare(primitive.positions, primitive.indices);
    unshare(primitive.uv0, primitive.indices);
    unshare(primitive.uv1, primitive.indices);
    unshare(primitive.colors, primitive.indices);
    primitive.tangents.clear();
    std::iota(primitive.indices.begin(), primitive.indices.end(), 0U);
    primitive.normals.resize(primitive.positions.size());
    for (size_t i = 0; i + 2 < primitive.positions.size(); i += 3) {
        const glm::vec3 normal = faceNormal(primitive.positions[i], primitive.positions[i + 1],
                                            primitive.positions[i + 2]);
        primitive.normals[i] = primitive.normals[i + 1] = primitive.normals[i + 2] = normal;
    }
}

} // namespace froxel::gltf

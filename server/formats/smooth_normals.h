// Normals of a surface that has none.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace froxel::formats {

// Of each position the sum of its triangles' normals, by area, of length 1; up where it is none.
// `indices`: three a triangle, each less than the number of positions.
[[nodiscard]] inline std::vector<glm::vec3> smoothNormals(std::span<const glm::vec3> positions,
                                                          std::span<const uint32_t> indices) {
    std::vector<glm::vec3> normals(positions.size(), glm::vec3(0.0F));
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::vec3 first = positions[indices[i]];
        const glm::vec3 normal =
            glm::cross(positions[indices[i + 1]] - first, positions[indices[i + 2]] - first);
        for (size_t corner = 0; corner < 3; ++corner) {
            normals[indices[i + corner]] += normal;
        }
    }
    for (glm::vec3& normal : normals) {
        const float length = glm::length(normal);
        normal = length > 0 ? normal / length : glm::vec3(0, 0, 1);
    }
    return normals;
}

} // namespace froxel::formats

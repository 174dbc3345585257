// Normals of triangles and of the surfaces that they make. In double: the cross product of a large
// triangle overflows float, of a small one vanishes.
#pragma once

#include <glm/glm.hpp>

namespace froxel::gltf {

// As long as twice the triangle's area.
[[nodiscard]] inline glm::dvec3
areaNormal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return glm::cross(b - a, c - a);
}

// Of one areaNormal(), or of the sum of those that meet at a vertex. +Y where there is none.
[[nodiscard]] inline glm::vec3 unitNormal(const glm::dvec3& sum) {
    const double length = glm::length(sum);
    return length > 0 ? glm::vec3(sum / length) : glm::vec3(0, 1, 0);
}

} // namespace froxel::gltf

// A quad, and the triangles of a lattice of vertices.
#pragma once

#include "scene/scene.h"

namespace froxel::test {

// Two triangles a patch of a (columns + 1)-wide lattice of vertices.
inline void addPatches(scene::Primitive& p, uint32_t columns, uint32_t rows) {
    const uint32_t row = columns + 1;
    for (uint32_t y = 0; y < rows; ++y) {
        for (uint32_t x = 0; x < columns; ++x) {
            const uint32_t a = y * row + x;
            p.indices.insert(p.indices.end(), {a, a + 1, a + row, a + 1, a + row + 1, a + row});
        }
    }
}

// A quad of `cells` x `cells` from corner `o` along `u` and `v`, facing cross(u, v); texture
// coordinates run from 0 to 4.
inline scene::Primitive quad(
    const glm::vec3& o, const glm::vec3& u, const glm::vec3& v, uint32_t cells, uint32_t material) {
    scene::Primitive p;
    p.material = material;
    const glm::vec3 normal = glm::normalize(glm::cross(u, v));
    for (uint32_t y = 0; y <= cells; ++y) {
        for (uint32_t x = 0; x <= cells; ++x) {
            const glm::vec2 t = glm::vec2(x, y) / static_cast<float>(cells);
            p.positions.push_back(o + u * t.x + v * t.y);
            p.normals.push_back(normal);
            p.uv0.push_back(t * 4.0F);
            p.bounds.add(p.positions.back());
        }
    }
    addPatches(p, cells, cells);
    return p;
}

} // namespace froxel::test

// Boxes seen from outside and from inside.
#pragma once

#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <utility>

namespace froxel::scene {

// A box from -half to half about `middle`, whose sides face outwards; `sides` of them, the ceiling
// last.
inline Scene makeBox(const glm::dvec3& middle, double half, uint32_t sides = 6) {
    Primitive box;
    // x, x, y (the floor), z, z, y (the ceiling)
    const std::array<std::pair<int, int>, 6> order = {
        {{0, -1}, {0, 1}, {1, -1}, {2, -1}, {2, 1}, {1, 1}}};
    for (uint32_t side = 0; side < sides; ++side) {
        const auto [axis, sign] = order[side];
        glm::vec3 out(0);
        glm::vec3 right(0);
        out[axis] = static_cast<float>(sign);
        right[(axis + 1) % 3] = 1;
        const glm::vec3 up = glm::cross(out, right);
        const auto first = static_cast<uint32_t>(box.positions.size());
        for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
            box.positions.push_back(out + corner.x * right + corner.y * up);
            box.bounds.add(box.positions.back());
        }
        for (const uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
            box.indices.push_back(first + corner);
        }
    }
    Scene scene;
    scene.materials.resize(1);
    scene.meshes = {{"box", {box}}};
    glm::dmat4 place(half);
    place[3] = glm::dvec4(middle, 1);
    scene.instances.push_back({0, place, ""});
    scene.bounds_world.add(middle - half);
    scene.bounds_world.add(middle + half);
    return scene;
}

// The same box, seen from inside.
inline Scene makeRoom(const glm::dvec3& middle, double half, uint32_t sides = 6) {
    Scene scene = makeBox(middle, half, sides);
    auto& indices = scene.meshes[0].primitives[0].indices;
    for (size_t i = 0; i < indices.size(); i += 3) {
        std::swap(indices[i], indices[i + 1]);
    }
    return scene;
}

} // namespace froxel::scene

// Leaves out triangles that cannot cover a pixel centre: outside the view, facing away, or between
// the centres. For software rasterisers, which spend 300 ns on a triangle before its first pixel.
#pragma once

#include "render/scene/geometry_pack.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace froxel::render {

struct TriangleCull {
    glm::mat4 clip_from_object{1};
    glm::vec2 half_size_px{0};
    bool cull_back = true; // single-sided
    bool mirrored = false; // the instance turns the winding round
};

// Appends the surviving triangles' indices into positions to `out`.
void appendVisibleTriangles(const TriangleCull& cull,
                            const MeshletTriangles& meshlet,
                            std::span<const glm::vec3> positions,
                            std::vector<uint32_t>& out);

} // namespace froxel::render

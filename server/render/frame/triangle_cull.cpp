#include "render/frame/triangle_cull.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace froxel::render {

namespace {

// Rasterisers snap to 1/256 pixel and our transform rounds: how far a corner may move.
constexpr float kSlack_px = 1.0F / 64.0F;
// A corner this near to the eye plane may be clipped: keep its triangle.
constexpr float kSmallestW = 1e-4F;

// A vertex in the picture, in pixels from its middle, y down, and the pixels whose centres may be
// on either side of it, as {from x, from y, -to x, -to y}: a triangle's are the least of each.
using Pixels __attribute__((vector_size(16))) = float; // of GCC and Clang: one operation for all
struct Corner {
    Pixels pixels;
    float x;
    float y;
};

Pixels least(Pixels a, Pixels b) {
    return a < b ? a : b;
}

Pixels roundedUp(Pixels values) {
    using Whole __attribute__((vector_size(16))) = int;
    const Pixels whole = __builtin_convertvector(__builtin_convertvector(values, Whole), Pixels);
    return values > whole ? whole + 1.0F : whole;
}

// False: it says nothing, since it is not ahead of the eye.
bool project(const TriangleCull& cull, const glm::vec3& p, Corner& corner) {
    const glm::vec4 clip = cull.clip_from_object * glm::vec4(p, 1.0F);
    const float inv_w = 1.0F / clip.w;
    corner.x = clip.x * inv_w * cull.half_size_px.x;
    corner.y = clip.y * inv_w * cull.half_size_px.y;
    // Centres lie at k + 0.5. Far outside one place is as good as another.
    constexpr Pixels kFar = {1e6F, 1e6F, 1e6F, 1e6F};
    const float x = corner.x + cull.half_size_px.x - 0.5F;
    const float y = corner.y + cull.half_size_px.y - 0.5F;
    const Pixels from = Pixels{x, y, -x, -y} - kSlack_px;
    corner.pixels = roundedUp(-least(-least(from, kFar), kFar));
    return clip.w > kSmallestW;
}

// picture: its pixels, as Corner::pixels.
bool visible(
    const TriangleCull& cull, Pixels picture, const Corner& a, const Corner& b, const Corner& c) {
    const Pixels of_triangle = least(least(a.pixels, b.pixels), c.pixels);
    const Pixels pixels = of_triangle > picture ? of_triangle : picture;
    if (pixels[0] + pixels[2] > 0 || pixels[1] + pixels[3] > 0) {
        return false;
    }
    if (!cull.cull_back) {
        return true;
    }
    // Twice the area, positive where counter-clockwise as seen (y down turns the sign).
    const glm::vec2 ab(b.x - a.x, b.y - a.y);
    const glm::vec2 ac(c.x - a.x, c.y - a.y);
    const float area = ac.x * ab.y - ab.x * ac.y;
    // No less than the triangle's width and height.
    const float extent = std::abs(ab.x) + std::abs(ab.y) + std::abs(ac.x) + std::abs(ac.y);
    const float slack = 2.0F * kSlack_px * (extent + kSlack_px);
    return (cull.mirrored ? -area : area) > -slack;
}

constexpr size_t kMostVertices = 256;
constexpr size_t kAhead = 8; // vertices that memory brings while others are projected

} // namespace

void appendVisibleTriangles(const TriangleCull& cull,
                            const MeshletTriangles& meshlet,
                            std::span<const glm::vec3> positions,
                            std::vector<uint32_t>& out) {
    std::array<Corner, kMostVertices> corners; // NOLINT(*-member-init): those in use are set
    std::array<bool, kMostVertices> ahead;     // NOLINT(*-member-init)
    bool all_ahead = true;
    const auto& vertices = meshlet.vertices;
    for (size_t i = 0; i < vertices.size(); ++i) {
        if (i + kAhead < vertices.size()) {
            __builtin_prefetch(&positions[vertices[i + kAhead]]);
        }
        ahead[i] = project(cull, positions[vertices[i]], corners[i]);
        all_ahead = all_ahead && ahead[i];
    }
    // From the picture's first pixel to its last.
    const Pixels picture = {0, 0, 1 - 2 * cull.half_size_px.x, 1 - 2 * cull.half_size_px.y};
    for (const uint32_t triangle : meshlet.triangles) {
        const uint32_t a = localVertex(triangle, 0);
        const uint32_t b = localVertex(triangle, 1);
        const uint32_t c = localVertex(triangle, 2);
        if ((!all_ahead && !(ahead[a] && ahead[b] && ahead[c])) ||
            visible(cull, picture, corners[a], corners[b], corners[c])) {
            out.insert(out.end(), {vertices[a], vertices[b], vertices[c]});
        }
    }
}

} // namespace froxel::render

#include "render/frame/triangle_cull.h"

#include <algorithm>
#include <cmath>

namespace froxel::render {

namespace {

// Rasterisers snap to 1/256 pixel and our transform rounds: how far a corner may move.
constexpr float kSlack_px = 1.0F / 64.0F;
// A corner this near to the eye plane may be clipped: keep its triangle.
constexpr float kSmallestW = 1e-4F;

struct Corner {
    float x, y, w; // pixels from the picture's centre, y down; w > 0 ahead of the eye
};

Corner project(const TriangleCull& cull, const glm::vec3& p) {
    const glm::vec4 clip = cull.clip_from_object * glm::vec4(p, 1.0F);
    const float inv_w = 1.0F / clip.w;
    return {clip.x * inv_w * cull.half_size_px.x, clip.y * inv_w * cull.half_size_px.y, clip.w};
}

// Whether [low, high] (pixels from the centre) holds a pixel centre, which lie at half + k + 0.5.
bool holdsCenter(float low, float high, float half) {
    const float first = std::ceil(low - kSlack_px + half - 0.5F);
    return first <= high + kSlack_px + half - 0.5F;
}

bool visible(const TriangleCull& cull, const Corner& a, const Corner& b, const Corner& c) {
    if (!(std::min({a.w, b.w, c.w}) > kSmallestW)) {
        return true;
    }
    const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
    const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
    const glm::vec2 edge = cull.half_size_px + kSlack_px;
    if (low_x > edge.x || high_x < -edge.x || low_y > edge.y || high_y < -edge.y) {
        return false;
    }
    if (!holdsCenter(low_x, high_x, cull.half_size_px.x) ||
        !holdsCenter(low_y, high_y, cull.half_size_px.y)) {
        return false;
    }
    if (cull.cull_back) {
        // Twice the area, positive where counter-clockwise as seen (y down turns the sign).
        const float area = (c.x - a.x) * (b.y - a.y) - (b.x - a.x) * (c.y - a.y);
        const float slack = 2.0F * kSlack_px * ((high_x - low_x) + (high_y - low_y) + kSlack_px);
        return (cull.mirrored ? -area : area) > -slack;
    }
    return true;
}

} // namespace

void appendVisibleTriangles(const TriangleCull& cull,
                            std::span<const uint32_t> indices,
                            std::span<const glm::vec3> positions,
                            std::vector<uint32_t>& out) {
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        const Corner a = project(cull, positions[indices[i]]);
        const Corner b = project(cull, positions[indices[i + 1]]);
        const Corner c = project(cull, positions[indices[i + 2]]);
        if (visible(cull, a, b, c)) {
            out.insert(out.end(), {indices[i], indices[i + 1], indices[i + 2]});
        }
    }
}

} // namespace froxel::render

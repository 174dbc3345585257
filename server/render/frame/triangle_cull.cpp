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

// A corner in the picture, in pixels from its middle, y down, and the pixels whose centres may be
// on either side of it: those of a triangle lie from the least `from` to the greatest `to`.
struct Corner {
    glm::vec2 at;
    glm::ivec2 from;
    glm::ivec2 to;
    bool ahead; // of the eye; else the others say nothing
};

int roundedUp(float value) {
    const auto whole = static_cast<int>(value);
    return whole + (value > static_cast<float>(whole) ? 1 : 0);
}

Corner project(const TriangleCull& cull, const glm::vec3& p) {
    const glm::vec4 clip = cull.clip_from_object * glm::vec4(p, 1.0F);
    const float inv_w = 1.0F / clip.w;
    const glm::vec2 at = glm::vec2(clip) * inv_w * cull.half_size_px;
    // Centres lie at k + 0.5. Far outside one place is as good as another.
    const glm::vec2 centres =
        glm::clamp(at + cull.half_size_px - 0.5F, glm::vec2(-1e6F), glm::vec2(1e6F));
    return {at,
            {roundedUp(centres.x - kSlack_px), roundedUp(centres.y - kSlack_px)},
            {-roundedUp(-centres.x - kSlack_px), -roundedUp(-centres.y - kSlack_px)},
            clip.w > kSmallestW};
}

bool visible(const TriangleCull& cull,
             const glm::ivec2& last_pixel,
             const Corner& a,
             const Corner& b,
             const Corner& c) {
    if (!(a.ahead && b.ahead && c.ahead)) {
        return true;
    }
    const glm::ivec2 from = glm::max(glm::min(glm::min(a.from, b.from), c.from), glm::ivec2(0));
    const glm::ivec2 to = glm::min(glm::max(glm::max(a.to, b.to), c.to), last_pixel);
    if (from.x > to.x || from.y > to.y) {
        return false;
    }
    if (cull.cull_back) {
        // Twice the area, positive where counter-clockwise as seen (y down turns the sign).
        const glm::vec2 ab = b.at - a.at;
        const glm::vec2 ac = c.at - a.at;
        const float area = ac.x * ab.y - ab.x * ac.y;
        const glm::vec2 size =
            glm::max(glm::max(a.at, b.at), c.at) - glm::min(glm::min(a.at, b.at), c.at);
        const float slack = 2.0F * kSlack_px * (size.x + size.y + kSlack_px);
        return (cull.mirrored ? -area : area) > -slack;
    }
    return true;
}

// Corners that neighbouring triangles share are projected once, mostly: a direct-mapped cache by
// vertex. Meshlets have 96 vertices and four times as many corners.
class Projected {
  public:
    Projected(const TriangleCull& cull, std::span<const glm::vec3> positions)
        : cull_(cull), positions_(positions) {
        vertices_.fill(kNone);
    }
    const Corner& at(uint32_t vertex) {
        const uint32_t place = vertex % kPlaces;
        if (vertices_[place] != vertex) {
            vertices_[place] = vertex;
            corners_[place] = project(cull_, positions_[vertex]);
        }
        return corners_[place];
    }

  private:
    static constexpr uint32_t kPlaces = 512;
    static constexpr uint32_t kNone = 0xffffffff;
    const TriangleCull& cull_;
    std::span<const glm::vec3> positions_;
    std::array<uint32_t, kPlaces> vertices_;
    std::array<Corner, kPlaces> corners_;
};

} // namespace

void appendVisibleTriangles(const TriangleCull& cull,
                            std::span<const uint32_t> indices,
                            std::span<const glm::vec3> positions,
                            std::vector<uint32_t>& out) {
    Projected projected(cull, positions);
    const glm::ivec2 last_pixel(cull.half_size_px * 2.0F - 1.0F);
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        // Copies: another corner may take a place.
        const Corner a = projected.at(indices[i]);
        const Corner b = projected.at(indices[i + 1]);
        if (visible(cull, last_pixel, a, b, projected.at(indices[i + 2]))) {
            out.insert(out.end(), {indices[i], indices[i + 1], indices[i + 2]});
        }
    }
}

} // namespace froxel::render

#include "render/frame/covered_part.h"

#include <cstdint>

namespace froxel::render {

vk::Rect2D coveredPart(const glm::mat4& clip_from_view,
                       const glm::vec3& center_view,
                       float radius_m,
                       const glm::vec2& half_size_px) {
    const glm::vec2 size_px = 2.0F * half_size_px;
    const glm::vec4 clip = clip_from_view * glm::vec4(center_view, 1.0F);
    const bool perspective = clip_from_view[3][3] == 0;
    glm::vec2 low(0);
    glm::vec2 high = size_px;
    if (!perspective || clip.w > 2 * radius_m) {
        // From twice its radius away a ball's outline has at most 2 / sqrt(3) of its size, and more
        // by the slant of where it stands.
        const glm::vec2 middle = glm::vec2(clip) / clip.w;
        const float grown = perspective ? 1.2F * radius_m / clip.w : radius_m;
        const glm::vec2 scale(clip_from_view[0][0], clip_from_view[1][1]);
        const glm::vec2 reach = grown * (glm::abs(scale) + glm::abs(middle) * 1.2F) * 1.2F;
        low = glm::clamp((middle - reach + 1.0F) * half_size_px, glm::vec2(0), size_px);
        high = glm::clamp((middle + reach + 1.0F) * half_size_px, glm::vec2(0), size_px);
    }
    const glm::ivec2 first(glm::floor(low));
    const glm::uvec2 extent(glm::ceil(high) - glm::floor(low));
    return {{first.x, first.y}, {extent.x, extent.y}};
}

} // namespace froxel::render

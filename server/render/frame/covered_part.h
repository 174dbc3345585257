// Where a ball may show in a picture.
#pragma once

#include "gpu/vulkan.h"

#include <glm/glm.hpp>

namespace froxel::render {

// In pixels, within the picture of twice `half_size_px`; all of it from near by. Center and radius
// in view space. Pure.
[[nodiscard]] vk::Rect2D coveredPart(const glm::mat4& clip_from_view,
                                     const glm::vec3& center_view,
                                     float radius_m,
                                     const glm::vec2& half_size_px);

} // namespace froxel::render

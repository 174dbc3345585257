// Small helpers of the painted surfaces.
#pragma once

#include "core/math.h"

#include <algorithm>
#include <cstdint>

namespace froxel::builtin_scene {

[[nodiscard]] inline float saturate(float x) {
    return std::clamp(x, 0.0F, 1.0F);
}

[[nodiscard]] inline float ramp(float from, float to, float x) {
    const float t = saturate((x - from) / (to - from));
    return t * t * (3.0F - 2.0F * t);
}

[[nodiscard]] inline glm::vec3 blend(glm::vec3 a, glm::vec3 b, float t) {
    return a + (b - a) * t;
}

// An sRGB colour written as on the web.
[[nodiscard]] constexpr glm::vec3 rgb(uint32_t hex) {
    return {static_cast<float>((hex >> 16U) & 255U) / 255.0F,
            static_cast<float>((hex >> 8U) & 255U) / 255.0F,
            static_cast<float>(hex & 255U) / 255.0F};
}

} // namespace froxel::builtin_scene

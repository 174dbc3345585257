// What a light's strength follows from, in double (shaders/lib/brdf.glsl has it in fp32).
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>

namespace froxel::light {

// Nearer than this a light's distance counts as this.
inline constexpr double kNearest_m = 0.01;

[[nodiscard]] inline double strongestChannel(const glm::vec3& color) {
    return static_cast<double>(std::max({color.x, color.y, color.z}));
}

} // namespace froxel::light

// Colours of files that say nothing of light: sRGB.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/color_space.hpp>

namespace froxel::formats {

// Of sRGB, each 0 to 1; what is beyond is taken for the nearest. In doubles: 1 stays 1.
[[nodiscard]] inline glm::vec3 linearOfSrgb(const glm::dvec3& srgb) {
    return glm::convertSRGBToLinear(glm::clamp(srgb, 0.0, 1.0));
}

} // namespace froxel::formats

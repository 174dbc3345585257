// What a light's strength follows from, in double (shaders/lib/brdf.glsl has it in fp32).
#pragma once

#include "core/math.h"

#include <algorithm>

namespace froxel::light {

// Nearer than this a light's distance counts as this; in a small scene than less.
inline constexpr double kNearest_m = 0.01;

// That distance: a 400th of the scene's diagonal, but at most 1 cm, so that scenes of 4 m and more
// have that. A small scene and its lights then look like the same ones made larger.
[[nodiscard]] inline double nearestDistance(const BoundsD3& scene_bounds_world) {
    constexpr double kLeast_m = 1e-15; // a scene of one point
    return scene_bounds_world.empty()
               ? kNearest_m
               : std::clamp(glm::length(scene_bounds_world.size()) / 400, kLeast_m, kNearest_m);
}

// What toon bands take a light's radius as at most, so that one that reaches far beyond a scene has
// more than one band in it: half of the scene's diagonal.
[[nodiscard]] inline double mostBandedRadius(const BoundsD3& scene_bounds_world) {
    constexpr double kLeast_m = 1e-15;
    return scene_bounds_world.empty()
               ? 1
               : std::max(glm::length(scene_bounds_world.size()) / 2, kLeast_m);
}

// Of linear colours with Rec. 709's primaries.
[[nodiscard]] inline double luminanceOf(const glm::dvec3& color) {
    return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722));
}

[[nodiscard]] inline double strongestChannel(const glm::vec3& color) {
    return static_cast<double>(std::max({color.x, color.y, color.z}));
}

} // namespace froxel::light

// Normals of microfacets drawn by GGX.
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace froxel::environment {

// In the unit square.
struct SquarePoint {
    double u = 0;
    double v = 0;
};

// A microfacet's normal about +Z, drawn as often as GGX has it: its density is D n.h.
[[nodiscard]] inline glm::dvec3 halfVector(const SquarePoint& point, double alpha) {
    const double cosine = std::sqrt((1 - point.u) / (1 + (alpha * alpha - 1) * point.u));
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const double around = 2 * std::numbers::pi * point.v;
    return {sine * std::cos(around), sine * std::sin(around), cosine};
}

} // namespace froxel::environment

// Panoramas by formula, and sums over all directions.
#pragma once

#include "core/linear_image.h"
#include "environment/panorama.h"

#include <array>
#include <cmath>
#include <numbers>

namespace froxel::environment {

inline const std::array<glm::dvec3, 6> kAxes = {
    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};

// Of the direction's greatest coordinate.
[[nodiscard]] size_t nearestAxis(const glm::dvec3& direction);

// radiance(direction) at the centres of texels.
template <class Radiance>
[[nodiscard]] LinearImage panoramaOf(uint32_t width_px, const Radiance& radiance) {
    LinearImage image{width_px, width_px / 2, {}};
    for (uint32_t y = 0; y < image.height_px; ++y) {
        for (uint32_t x = 0; x < image.width_px; ++x) {
            const glm::dvec3 value =
                radiance(directionAt({(x + 0.5) / width_px, (y + 0.5) / image.height_px}));
            for (const double channel : {value.x, value.y, value.z}) {
                image.rgb.push_back(static_cast<float>(channel));
            }
        }
    }
    return image;
}

// visit(direction) of Fibonacci's lattice, which covers the sphere evenly.
template <class Visit>
void eachDirection(int count, const Visit& visit) {
    for (int i = 0; i < count; ++i) {
        const double y = 1 - (2 * i + 1.0) / count;
        const double r = std::sqrt(1 - y * y);
        const double around = 2 * std::numbers::pi * std::fmod(i * std::numbers::phi, 1.0);
        visit(glm::dvec3(r * std::cos(around), y, r * std::sin(around)));
    }
}

} // namespace froxel::environment

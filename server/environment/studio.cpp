#include "environment/studio.h"

#include "environment/panorama.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace froxel::environment {
namespace {

// 1 within, 0 outside, linear over the edge.
double within(double position, double half, double edge) {
    return std::clamp((half - std::abs(position)) / edge + 0.5, 0.0, 1.0);
}

double radianceOf(const SoftBox& box, const glm::dvec3& direction) {
    const double azimuth = glm::radians(box.azimuth_deg);
    const double elevation = glm::radians(box.elevation_deg);
    const glm::dvec3 centre(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                            std::cos(azimuth) * std::cos(elevation));
    const double along = glm::dot(centre, direction);
    if (along <= 0) {
        return 0;
    }
    const glm::dvec3 right(std::cos(azimuth), 0, -std::sin(azimuth));
    const glm::dvec3 up = glm::cross(centre, right);
    return box.radiance * within(glm::dot(right, direction) / along, box.half_width, box.edge) *
           within(glm::dot(up, direction) / along, box.half_height, box.edge);
}

} // namespace

double studioRadiance(const glm::dvec3& direction) {
    double sum = glm::mix(kStudioGround, kStudioCeiling, 0.5 + 0.5 * direction.y);
    for (const SoftBox& box : kSoftBoxes) {
        sum += radianceOf(box, direction);
    }
    return sum;
}

LinearImage studioPanorama(uint32_t width_px) {
    LinearImage image{width_px, width_px / 2, {}};
    image.rgb.reserve(size_t{3} * image.width_px * image.height_px);
    for (uint32_t y = 0; y < image.height_px; ++y) {
        for (uint32_t x = 0; x < image.width_px; ++x) {
            const auto value = static_cast<float>(studioRadiance(
                directionAt({(x + 0.5) / image.width_px, (y + 0.5) / image.height_px})));
            image.rgb.insert(image.rgb.end(), 3, value);
        }
    }
    return image;
}

} // namespace froxel::environment

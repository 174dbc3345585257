#include "environment/panorama.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace froxel::environment {
namespace {

constexpr double kPi = std::numbers::pi;

} // namespace

glm::dvec3 directionAt(const glm::dvec2& place) {
    const double around = 2 * kPi * (place.x - 0.5);
    const double down = kPi * place.y;
    return {std::sin(down) * std::cos(around), std::cos(down), std::sin(down) * std::sin(around)};
}

glm::dvec2 placeOf(const glm::dvec3& direction) {
    return {0.5 + std::atan2(direction.z, direction.x) / (2 * kPi),
            std::acos(std::clamp(direction.y, -1.0, 1.0)) / kPi};
}

glm::dvec3 turned(const glm::dvec3& direction, double angle_rad) {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return {c * direction.x + s * direction.z, direction.y, c * direction.z - s * direction.x};
}

double texelSolidAngle(const LinearImage& panorama, uint32_t row) {
    const double top = std::cos(kPi * row / panorama.height_px);
    const double bottom = std::cos(kPi * (row + 1) / panorama.height_px);
    return (top - bottom) * 2 * kPi / panorama.width_px;
}

glm::dvec3 texel(const LinearImage& panorama, uint32_t column, uint32_t row) {
    const float* rgb = &panorama.rgb[(size_t{row} * panorama.width_px + column) * 3];
    return {rgb[0], rgb[1], rgb[2]};
}

glm::dvec3 radianceFrom(const LinearImage& panorama, const glm::dvec3& direction) {
    const auto width = static_cast<int64_t>(panorama.width_px);
    const auto height = static_cast<int64_t>(panorama.height_px);
    const glm::dvec2 at = placeOf(direction) * glm::dvec2(width, height) - 0.5;
    const glm::dvec2 corner = glm::floor(at);
    const glm::dvec2 share = at - corner;
    const auto inRow = [&](int64_t y) {
        const auto row = static_cast<uint32_t>(std::clamp<int64_t>(y, 0, height - 1));
        const auto column = [&](int64_t x) {
            return texel(panorama, static_cast<uint32_t>((x + width) % width), row);
        };
        const auto x = static_cast<int64_t>(corner.x);
        return glm::mix(column(x), column(x + 1), share.x);
    };
    const auto y = static_cast<int64_t>(corner.y);
    return glm::mix(inRow(y), inRow(y + 1), share.y);
}

glm::dvec3 meanRadiance(const LinearImage& panorama) {
    glm::dvec3 sum(0);
    for (uint32_t y = 0; y < panorama.height_px; ++y) {
        glm::dvec3 of_row(0);
        for (uint32_t x = 0; x < panorama.width_px; ++x) {
            of_row += texel(panorama, x, y);
        }
        sum += of_row * texelSolidAngle(panorama, y);
    }
    return sum / (4 * kPi);
}

} // namespace froxel::environment

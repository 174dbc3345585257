#include "cluster/light_spread.h"

#include <algorithm>
#include <cmath>

namespace froxel::cluster {
namespace {

// Half the side of a cube as large as a ball of radius 1: cbrt(4 pi / 3) / 2.
constexpr double kHalfCubeOfBall = 0.806;
constexpr size_t kSeenDepths = 16;

// Whether the ball may reach the picture; generous behind its corners.
bool seen(const ClusterGrid& grid, const glm::dvec3& position_view, double radius) {
    const double depth = -position_view.z;
    if (depth + radius < 0) {
        return false;
    }
    const bool flat = grid.projection == settings::Projection::kOrthographic;
    const auto within = [&](double value, double middle, double half) {
        const double scale = flat ? 1.0 : std::max(depth, 0.0);
        const double slope = flat ? 0.0 : std::abs(middle) + half;
        return std::abs(value - middle * scale) <=
               half * scale + radius * std::sqrt(1 + slope * slope);
    };
    return within(position_view.x, grid.middle_x, grid.half_x) &&
           within(-position_view.y, grid.middle_y, grid.half_y);
}

double blockVolume(const glm::dvec3& mean, const glm::dmat3& mean_products, double radius_m) {
    glm::dmat3 extents2; // squared: a uniform block's variance is a twelfth of its squared side
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            extents2[i][j] = 12 * (mean_products[i][j] - mean[i] * mean[j]);
        }
        extents2[i][i] += kHalfCubeOfBall * kHalfCubeOfBall * radius_m * radius_m;
    }
    return std::sqrt(std::max(glm::determinant(extents2), 0.0));
}

} // namespace

LightSpread lightSpread(const ClusterGrid& grid, const light::FrameLights& lights) {
    LightSpread spread;
    const size_t count = lights.lights.size();
    spread.light_count = static_cast<uint32_t>(count);
    const size_t samples = std::min(count, kSpreadSamples);
    glm::dvec3 sum(0);
    glm::dmat3 products(0);
    size_t limited = 0;
    std::vector<double> seen_depths;
    for (size_t sample = 0; sample < samples; ++sample) {
        const size_t i = sample * count / samples;
        const auto radius = static_cast<double>(lights.radii_m[i]);
        if (std::isinf(radius)) {
            continue;
        }
        const glm::dvec3 position(lights.lights[i].position_view);
        ++limited;
        spread.radius1_m += radius;
        spread.radius2_m2 += radius * radius;
        spread.radius3_m3 += radius * radius * radius;
        sum += position;
        products += glm::outerProduct(position, position);
        if (seen(grid, position, radius)) {
            seen_depths.push_back(std::max(-position.z, 0.0));
        }
    }
    if (limited > 0) {
        const double share = 1.0 / static_cast<double>(limited);
        spread.radius1_m *= share;
        spread.radius2_m2 *= share;
        spread.radius3_m3 *= share;
        spread.volume_m3 = blockVolume(sum * share, products * share, spread.radius1_m);
    }
    if (samples > 0) {
        const double stands_for = static_cast<double>(count) / static_cast<double>(samples);
        spread.unlimited_share =
            static_cast<double>(samples - limited) / static_cast<double>(samples);
        // The median depth of each of kSeenDepths equal parts.
        std::sort(seen_depths.begin(), seen_depths.end());
        const size_t kept = std::min(seen_depths.size(), kSeenDepths);
        for (size_t i = 0; i < kept; ++i) {
            spread.seen_depths_m.push_back(
                seen_depths[(2 * i + 1) * seen_depths.size() / (2 * kept)]);
        }
        spread.lights_per_depth = kept > 0 ? stands_for * static_cast<double>(seen_depths.size()) /
                                                 static_cast<double>(kept)
                                           : 0.0;
    }
    return spread;
}

} // namespace froxel::cluster

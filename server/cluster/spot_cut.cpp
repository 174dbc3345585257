#include "cluster/spot_cut.h"

#include <algorithm>
#include <cmath>

namespace froxel::cluster {
namespace {

// Shading compares cosines in fp32: its dot product, normalisation, scale and offset are together
// off by less than this. In angle it is most for narrow cones: 0.11 degrees at 0.
constexpr double kCosineSlack = 2e-6;
// Positions in fp32 are off by less than this share of their distance from the eye.
constexpr double kPositionSlack = 1e-6;
const double kWidestCosine = std::cos(glm::radians(80.0));
constexpr int kRounds = 3;

// The corner of a cell that lies least along a direction; y and x vary on their own at one depth.
glm::dvec3 leastCorner(const Cell& cell, view::Projection projection, const glm::dvec3& along) {
    const double x = along.x > 0 ? cell.x0 : cell.x1;
    const double y = along.y > 0 ? cell.y0 : cell.y1;
    if (projection == view::Projection::kOrthographic) {
        return {x, y, along.z > 0 ? cell.z0 : cell.z1};
    }
    const double per_depth = along.x * x + along.y * y + along.z;
    const double z = per_depth > 0 ? cell.z0 : cell.z1;
    return {x * z, y * z, z};
}

glm::dvec3 middle(const Cell& cell, view::Projection projection) {
    const double z = (cell.z0 + cell.z1) / 2;
    const double scale = projection == view::Projection::kPerspective ? z : 1.0;
    return {(cell.x0 + cell.x1) / 2 * scale, (cell.y0 + cell.y1) / 2 * scale, z};
}

} // namespace

SpotCut::SpotCut(const glm::dvec3& apex, const glm::dvec3& axis, double cos_half, double range)
    : apex_(apex), axis_(axis), cos_half_(cos_half),
      sin_half_(std::sqrt(std::max(0.0, 1 - cos_half * cos_half))), range_(range) {}

std::optional<SpotCut> SpotCut::make(const glm::dvec3& apex_cell,
                                     const glm::dvec3& direction_view,
                                     const light::SpotCone& cone,
                                     double range) {
    const double cos_half = cone.cos_outer - kCosineSlack;
    if (!(cos_half >= kWidestCosine)) {
        return std::nullopt;
    }
    const glm::dvec3 axis(direction_view.x, -direction_view.y, -direction_view.z);
    return SpotCut(apex_cell, glm::normalize(axis), cos_half, range);
}

// Up to 45 degrees the smallest ball passes through apex and rim, above it is the rim's own.
Ball SpotCut::bound() const {
    const bool narrow = cos_half_ > sin_half_;
    const double along = narrow ? range_ / (2 * cos_half_) : range_ * cos_half_;
    const double radius = narrow ? along : range_ * sin_half_;
    const glm::dvec3 centre = apex_ + axis_ * along;
    return {centre.x, centre.y, centre.z, radius};
}

// Looks for a plane with the spot on one side and the cell on the other: one that touches the cone
// or the cap, first on the side of the cell's middle, then on that of the corner which crossed it.
bool SpotCut::misses(const Cell& cell, view::Projection projection) const {
    const glm::dvec3 corner(std::max(std::abs(cell.x0), std::abs(cell.x1)),
                            std::max(std::abs(cell.y0), std::abs(cell.y1)), 1);
    const double reach = projection == view::Projection::kPerspective
                             ? cell.z1 * glm::length(corner)
                             : cell.z1 + corner.x + corner.y;
    const double slack = kPositionSlack * (reach + glm::length(apex_));
    glm::dvec3 toward = middle(cell, projection) - apex_;
    for (int round = 0; round < kRounds; ++round) {
        const double along = glm::dot(toward, axis_);
        const glm::dvec3 aside = toward - axis_ * along;
        const double aside_length = glm::length(aside);
        if (!(aside_length * cos_half_ > along * sin_half_) || !(aside_length > 0)) {
            break; // this point is within the cone
        }
        const glm::dvec3 normal = aside * (cos_half_ / aside_length) - axis_ * sin_half_;
        const glm::dvec3 nearest = leastCorner(cell, projection, normal) - apex_;
        if (glm::dot(nearest, normal) > slack) {
            return true;
        }
        toward = nearest;
    }
    toward = middle(cell, projection) - apex_;
    for (int round = 0; round < kRounds; ++round) {
        const double distance = glm::length(toward);
        if (!(distance > range_)) {
            break;
        }
        const glm::dvec3 normal = toward / distance;
        const glm::dvec3 nearest = leastCorner(cell, projection, normal) - apex_;
        if (glm::dot(nearest, normal) > range_ + slack) {
            return true;
        }
        toward = nearest;
    }
    return false;
}

} // namespace froxel::cluster

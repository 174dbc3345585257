#include "cluster/spot_cut.h"

#include <algorithm>
#include <cmath>

namespace froxel::cluster {
namespace {

// Shading compares cosines in fp32: its dot product, normalisation, scale and offset are together
// off by less than this. In angle it is most for narrow cones: 0.11 degrees at 0.
constexpr double kCosineSlack = 2e-6;
const double kWidestCosine = std::cos(glm::radians(80.0));

} // namespace

std::optional<SpotCut> SpotCut::make(const glm::dvec3& apex_cell,
                                     const glm::dvec3& direction_view,
                                     const light::SpotCone& cone,
                                     double range) {
    const double cos_half = cone.cos_outer - kCosineSlack;
    if (!(cos_half >= kWidestCosine)) {
        return std::nullopt;
    }
    const glm::dvec3 axis(direction_view.x, -direction_view.y, -direction_view.z);
    return SpotCut({.apex = apex_cell,
                    .axis = glm::normalize(axis),
                    .cos_half = cos_half,
                    .sin_half = std::sqrt(std::max(0.0, 1 - cos_half * cos_half)),
                    .range = std::min(range, io::kAssignFar)});
}

// Up to 45 degrees the smallest ball passes through apex and rim, above it is the rim's own.
Ball SpotCut::bound() const {
    const bool narrow = cone_.cos_half > cone_.sin_half;
    const double along = narrow ? cone_.range / (2 * cone_.cos_half) : cone_.range * cone_.cos_half;
    const double radius = narrow ? along : cone_.range * cone_.sin_half;
    const glm::dvec3 centre = cone_.apex + cone_.axis * along;
    return {centre.x, centre.y, centre.z, radius};
}

bool SpotCut::misses(const Cell& cell, settings::Projection projection) const {
    return io::coneMisses(cone_, {cell.x0, cell.x1, cell.y0, cell.y1, cell.z0, cell.z1,
                                  projection == settings::Projection::kPerspective});
}

} // namespace froxel::cluster

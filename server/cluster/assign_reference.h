// The oracle of the tests: slow, in double, and by another route than the assigner.
#pragma once

#include "cluster/ball_sweep.h"
#include "cluster/cluster_grid.h"
#include "core/math.h"

#include <vector>

namespace froxel::cluster::reference {

// The exact distance from a point (in the axes of Cell) to a cell: at a depth z, x and y are free
// on their own, so the squared distance is a convex function of z alone, made of parabolas; the
// least vertex or joint is taken.
[[nodiscard]] double
distance(const glm::dvec3& point, const Cell& cell, settings::Projection projection);

// All clusters whose cell has a point within the ball, ascending.
[[nodiscard]] std::vector<uint32_t> clustersOf(const ClusterGrid& grid, const Ball& ball);

// The largest cosine between `axis` (unit) and the way from `apex` to a point of the cell within
// `range`, found by dense sampling and refinement around the best sample; -2 if no sample is in
// range. Never larger than the true one.
[[nodiscard]] double largestCosine(const glm::dvec3& apex,
                                   const glm::dvec3& axis,
                                   double range,
                                   const Cell& cell,
                                   settings::Projection projection);

} // namespace froxel::cluster::reference

#include "cluster/assign_reference.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace froxel::cluster::reference {
namespace {

// How far `value` lies outside [low, high].
double outside(double value, double low, double high) {
    return std::max({0.0, low - value, value - high});
}

glm::dvec3 pointOf(const Cell& cell, settings::Projection projection, const glm::dvec3& share) {
    const double z = cell.z0 + (cell.z1 - cell.z0) * share.z;
    const double scale = projection == settings::Projection::kPerspective ? z : 1.0;
    return {(cell.x0 + (cell.x1 - cell.x0) * share.x) * scale,
            (cell.y0 + (cell.y1 - cell.y0) * share.y) * scale, z};
}

} // namespace

double distance(const glm::dvec3& point, const Cell& cell, settings::Projection projection) {
    const bool perspective = projection == settings::Projection::kPerspective;
    const auto distance2 = [&](double z) {
        const double scale = perspective ? z : 1.0;
        const double x = outside(point.x, cell.x0 * scale, cell.x1 * scale);
        const double y = outside(point.y, cell.y0 * scale, cell.y1 * scale);
        return x * x + y * y + (z - point.z) * (z - point.z);
    };
    double best = std::min(distance2(cell.z0), distance2(cell.z1));
    const auto consider = [&](double z) {
        if (z > cell.z0 && z < cell.z1) {
            best = std::min(best, distance2(z));
        }
    };
    consider(point.z);
    if (!perspective) {
        return std::sqrt(best);
    }
    // Where each side face is met (joints), and the vertex of every parabola: no, one or both of an
    // x face and a y face pull.
    const std::array<double, 3> xs = {0.0, cell.x0, cell.x1};
    const std::array<double, 3> ys = {0.0, cell.y0, cell.y1};
    for (size_t i = 0; i < xs.size(); ++i) {
        for (size_t j = 0; j < ys.size(); ++j) {
            const double x = i > 0 ? xs[i] : 0.0;
            const double y = j > 0 ? ys[j] : 0.0;
            consider((point.z + x * point.x + y * point.y) / (1 + x * x + y * y));
        }
        if (i > 0 && xs[i] != 0) {
            consider(point.x / xs[i]);
        }
        if (i > 0 && ys[i] != 0) {
            consider(point.y / ys[i]);
        }
    }
    return std::sqrt(best);
}

std::vector<uint32_t> clustersOf(const ClusterGrid& grid, const Ball& ball) {
    std::vector<uint32_t> clusters;
    for (uint32_t z = 0; z < grid.size.z; ++z) {
        for (uint32_t y = 0; y < grid.usedRows(); ++y) {
            for (uint32_t x = 0; x < grid.usedColumns(); ++x) {
                const double away =
                    distance({ball.x, ball.y, ball.z}, grid.cell(x, y, z), grid.projection);
                if (away <= ball.radius) {
                    clusters.push_back(grid.clusterIndex(x, y, z));
                }
            }
        }
    }
    return clusters;
}

double largestCosine(const glm::dvec3& apex,
                     const glm::dvec3& axis,
                     double range,
                     const Cell& cell,
                     settings::Projection projection) {
    constexpr int kSteps = 6;
    constexpr int kRounds = 12;
    double best = -2;
    glm::dvec3 low(0);
    glm::dvec3 high(1);
    for (int round = 0; round < kRounds; ++round) {
        glm::dvec3 best_share = (low + high) * 0.5;
        double round_best = -2;
        for (int i = 0; i <= kSteps; ++i) {
            for (int j = 0; j <= kSteps; ++j) {
                for (int k = 0; k <= kSteps; ++k) {
                    const glm::dvec3 share =
                        low + (high - low) * glm::dvec3(i, j, k) / double{kSteps};
                    const glm::dvec3 way = pointOf(cell, projection, share) - apex;
                    const double length = glm::length(way);
                    const double cosine = length > 0 ? glm::dot(way, axis) / length : 1.0;
                    if (length <= range && cosine > round_best) {
                        round_best = cosine;
                        best_share = share;
                    }
                }
            }
        }
        best = std::max(best, round_best);
        const glm::dvec3 half = (high - low) * 0.25;
        low = glm::clamp(best_share - half, 0.0, 1.0);
        high = glm::clamp(best_share + half, 0.0, 1.0);
    }
    return best;
}

} // namespace froxel::cluster::reference

#include "environment/pyramid.h"

#include "environment/panorama.h"

#include <glm/common.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace froxel::environment {
namespace {

// A cell's share in a coarser cell.
struct Share {
    uint32_t cell;
    double weight;
};
using Shares = std::vector<std::vector<Share>>; // of every coarser cell

// before(t): how much lies before t, both 0 to 1.
template <class Before>
Shares sharesOf(uint32_t fine, uint32_t coarse, const Before& before) {
    Shares shares(coarse);
    for (uint32_t i = 0; i < coarse; ++i) {
        const double begin = static_cast<double>(i) / coarse;
        const double end = (i + 1.0) / coarse;
        for (auto k = static_cast<uint32_t>(begin * fine); k < fine && k < end * fine; ++k) {
            const double from = std::max(begin, static_cast<double>(k) / fine);
            const double to = std::min(end, (k + 1.0) / fine);
            shares[i].push_back({k, (before(to) - before(from)) / (before(end) - before(begin))});
        }
    }
    return shares;
}

LinearImage coarser(const LinearImage& fine) {
    LinearImage out;
    out.width_px = std::bit_floor(fine.width_px - 1);
    out.height_px = out.width_px / 2;
    out.rgb.reserve(size_t{3} * out.width_px * out.height_px);
    const Shares columns = sharesOf(fine.width_px, out.width_px, [](double t) { return t; });
    const Shares rows = sharesOf(fine.height_px, out.height_px, [](double t) {
        return 0.5 - 0.5 * std::cos(std::numbers::pi * t);
    });
    for (const auto& row : rows) {
        for (const auto& column : columns) {
            glm::dvec3 sum(0);
            for (const Share& y : row) {
                for (const Share& x : column) {
                    sum += texel(fine, x.cell, y.cell) * (x.weight * y.weight);
                }
            }
            for (const double value : {sum.x, sum.y, sum.z}) {
                out.rgb.push_back(static_cast<float>(value));
            }
        }
    }
    return out;
}

} // namespace

Pyramid::Pyramid(LinearImage panorama) {
    levels_.push_back(std::move(panorama));
    while (levels_.back().width_px > 2) {
        levels_.push_back(coarser(levels_.back()));
    }
}

glm::dvec3 Pyramid::mean(const glm::dvec3& direction, double solid_angle) const {
    // A row's height is the angle that counts: columns only come closer towards the poles.
    const double wanted = std::numbers::pi / std::sqrt(solid_angle);
    const auto rows = [&](size_t level) { return static_cast<double>(levels_[level].height_px); };
    size_t coarse = 0;
    while (coarse < levels_.size() && rows(coarse) > wanted) {
        ++coarse;
    }
    if (coarse == 0 || coarse == levels_.size()) {
        return radianceFrom(levels_[std::min(coarse, levels_.size() - 1)], direction);
    }
    const double share =
        std::log(rows(coarse - 1) / wanted) / std::log(rows(coarse - 1) / rows(coarse));
    return glm::mix(radianceFrom(levels_[coarse - 1], direction),
                    radianceFrom(levels_[coarse], direction), share);
}

} // namespace froxel::environment

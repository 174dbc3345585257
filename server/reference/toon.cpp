#include "reference/toon.h"

#include <algorithm>
#include <cmath>

namespace froxel::reference {

double toonRamp(const settings::ToonRamp& ramp, double x) {
    uint32_t after = 0; // points at or before x
    while (after < ramp.count && x >= static_cast<double>(ramp.points[after].x)) {
        ++after;
    }
    if (after == 0 || after == ramp.count) {
        return static_cast<double>(ramp.points[after == 0 ? 0 : ramp.count - 1].y);
    }
    const auto& p = ramp.points[after - 1];
    const auto& q = ramp.points[after];
    const double width = static_cast<double>(q.x) - static_cast<double>(p.x);
    const double t = (x - static_cast<double>(p.x)) / width;
    const double s = 1 - t;
    return (1 + 2 * t) * s * s * static_cast<double>(p.y) +
           t * s * s * width * static_cast<double>(p.slope) +
           t * t * (3 - 2 * t) * static_cast<double>(q.y) -
           t * t * s * width * static_cast<double>(q.slope);
}

double toonBand(uint32_t bands, double light, double middle) {
    if (bands == 0 || light <= 0) {
        return bands == 0 ? light : 0;
    }
    const double share = middle > 0 ? light / (light + middle) : light;
    const double center = std::min(std::floor(std::sqrt(share) * bands), bands - 1.0) + 0.5;
    if (middle == 0) {
        return std::pow(center / (bands - 0.5), 2);
    }
    const double at = std::pow(center / bands, 2);
    return middle * at / (1 - at);
}

double toonGloss(double alpha) {
    return std::clamp(1 / (8 * alpha * alpha), 1.0, 25.0);
}

} // namespace froxel::reference

#include "cluster/slice_law.h"

#include <cmath>
#include <limits>

namespace froxel::cluster {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Fixed point of a linear far lies in [2^29, 2^30), of a hyperbolic near in [2^13, 2^14).
constexpr int kLinearBits = 30;
constexpr int kHyperbolicBits = 14;
constexpr double kHyperbolicRange = 8192;

float roundedUp(double value) {
    const auto rounded = static_cast<float>(value);
    return static_cast<double>(rounded) < value ? std::nextafter(rounded, kInfinity) : rounded;
}

// A power of two that takes `depth` to [2^(bits - 1), 2^bits).
float unitFor(double depth, int bits) {
    int exponent = 0;
    (void)std::frexp(depth, &exponent);
    return std::ldexp(1.0F, bits - exponent);
}

uint32_t fixedPoint(const SliceLaw& law, double depth) {
    return static_cast<uint32_t>(
        std::min(depth * static_cast<double>(law.unit), static_cast<double>(law.kMaxFixed)));
}

// Cuts [0, span] of the key into slices, as finely as 32 bits of scale allow: slices << shift stays
// below span, so that scale does.
void divideKey(SliceLaw& law, uint32_t slices, uint32_t span) {
    while ((uint64_t{slices} << (law.shift + 1U)) < span) {
        ++law.shift;
    }
    const uint64_t steps = uint64_t{slices} << (32U + law.shift);
    law.scale = static_cast<uint32_t>((steps + span - 1) / span);
}

} // namespace

SliceLaw makeSliceLaw(settings::GridLaw kind, uint32_t slices, double near_m, double far_m) {
    SliceLaw law{.kind = kind};
    if (kind == settings::GridLaw::kLogarithmic) {
        law.first = std::bit_cast<uint32_t>(static_cast<float>(near_m));
        const auto far_bits = std::bit_cast<uint32_t>(roundedUp(far_m));
        divideKey(law, slices, std::max(far_bits - std::min(far_bits, law.first), slices + 1U));
    } else if (kind == settings::GridLaw::kLinear) {
        law.unit = unitFor(far_m, kLinearBits);
        law.first = fixedPoint(law, near_m);
        // Neighbouring floats at far are up to 64 steps apart.
        const uint32_t least = 128U * (slices + 1U);
        divideKey(law, slices, std::max(fixedPoint(law, far_m) + 1U - law.first, least));
    } else {
        const double near = std::max(near_m, far_m / kHyperbolicRange);
        const double far = std::max(far_m, near * (1 + (slices + 1.0) / 4096));
        law.unit = unitFor(near, kHyperbolicBits);
        law.first = law.kHyperbola / fixedPoint(law, near);
        divideKey(law, slices, law.first - law.kHyperbola / fixedPoint(law, far) + 1U);
    }
    return law;
}

float planeDepth(const SliceLaw& law, uint32_t k) {
    const uint64_t steps = ((uint64_t{k} << (32U + law.shift)) + law.scale - 1) / law.scale;
    const auto key = static_cast<uint32_t>(steps);
    if (law.kind == settings::GridLaw::kLogarithmic) {
        return std::bit_cast<float>(law.first + key);
    }
    // The smallest fixed-point depth whose key is that large.
    const uint32_t fixed = law.kind == settings::GridLaw::kLinear
                               ? law.first + key
                               : law.kHyperbola / (law.first - key + 1U) + 1U;
    return roundedUp(static_cast<double>(fixed) / static_cast<double>(law.unit));
}

} // namespace froxel::cluster

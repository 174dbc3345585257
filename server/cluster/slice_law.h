// Which slice a depth is in, by integers: assignment and shaders agree to the last bit.
#pragma once

#include "settings/settings.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace froxel::cluster {

// A depth becomes a key, an integer that grows with it as the law wants and that no device rounds;
// equal steps of the key are slices. shaders/lib/frame.glsl holds the same formulas.
//   logarithmic: the bits of the float, piecewise linear in its logarithm (at most 6 % off).
//   linear: the depth in fixed point; the unit is a power of two, so the product is exact.
//   hyperbolic: a constant divided by that, in integers, and what is left of it at near: what NDC
//   depth does.
struct SliceLaw {
    settings::GridLaw kind = settings::GridLaw::kLogarithmic;
    float unit = 1;     // fixed-point steps a metre, a power of two; not logarithmic
    uint32_t first = 0; // the key (hyperbolic: the quotient) of near; nearer ones are in slice 0
    uint32_t scale = 0; // slices per step of the key, times 2^(32 + shift)
    uint32_t shift = 0;

    // Fixed-point depths end here: the largest float below 2^31.
    static constexpr float kMaxFixed = 2147483520.0F;
    static constexpr uint32_t kHyperbola = 0xffffffffU;

    // At or beyond the slice count: behind the last plane. depth_m must not be negative.
    [[nodiscard]] uint32_t sliceOf(float depth_m) const {
        return static_cast<uint32_t>((uint64_t{keyOf(depth_m)} * scale) >> (32U + shift));
    }

  private:
    [[nodiscard]] uint32_t keyOf(float depth_m) const {
        if (kind == settings::GridLaw::kLogarithmic) {
            return std::max(std::bit_cast<uint32_t>(depth_m), first) - first;
        }
        const auto fixed = static_cast<uint32_t>(std::min(depth_m * unit, kMaxFixed));
        if (kind == settings::GridLaw::kLinear) {
            return std::max(fixed, first) - first;
        }
        return first - std::min(kHyperbola / std::max(fixed, 1U), first);
    }
};

// The law under which the last of `slices` ends at far_m or just beyond (hyperbolic: up to 4 %
// beyond). Depths in [1e-9, 1e18], near <= far. Where they lie so close that slices would have no
// float of their own, far is moved; a hyperbolic near is raised to far / 8192.
[[nodiscard]] SliceLaw
makeSliceLaw(settings::GridLaw kind, uint32_t slices, double near_m, double far_m);

// The smallest float in slice k (of at least 1): where it begins, or where k - 1 ends.
[[nodiscard]] float planeDepth(const SliceLaw& law, uint32_t k);

} // namespace froxel::cluster

// Numbers from a hash, equal on every machine.
#pragma once

#include <array>
#include <cstdint>

namespace froxel::light {

// A bijective 64-bit mixer (xor-shift and multiply, three rounds): every input bit reaches every
// output bit. Integer arithmetic only, so that a seed means the same lights everywhere.
inline uint64_t mix(uint64_t value) {
    value ^= value >> 32U;
    value *= 0x9fb21c651e98df25U;
    value ^= value >> 29U;
    value *= 0xd6e8feb86659fd93U;
    value ^= value >> 32U;
    return value;
}

// Three independent fractions in [0, 1) of 21 bits each out of one hash.
struct Fractions {
    explicit Fractions(uint64_t hash) {
        constexpr uint64_t kMask = (1U << 21U) - 1U;
        constexpr double kScale = 1.0 / (1U << 21U);
        for (auto& value : values) {
            value = static_cast<double>(static_cast<int32_t>(hash & kMask)) * kScale;
            hash >>= 21U;
        }
    }
    std::array<double, 3> values;
};

} // namespace froxel::light

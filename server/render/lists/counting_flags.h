// Light flags of passes that count lights.
#pragma once

#include "interface/constants.h"

#include <cstdint>

namespace froxel::render {

// Only what decides which lights a pixel is handed. They are counted one by one: a GPU, which would
// wait for each, fetches several at once.
[[nodiscard]] inline uint32_t countingFlags(uint32_t light_flags, bool device_is_cpu) {
    constexpr uint32_t kKept = io::kLightLocal | io::kLightLists | io::kLightSpots |
                               io::kLightEqualRadii | io::kLightLong | io::kLightSlicesLinear |
                               io::kLightSlicesHyperbolic;
    return (light_flags & kKept) | (device_is_cpu ? 0U : io::kLightLong);
}

} // namespace froxel::render

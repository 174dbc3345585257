// How much lighting one frame may ask for: a submitted frame cannot be cancelled, others wait
// behind it, and one that takes minutes is taken for a lost device. Pure.
#pragma once

#include "core/error.h"
#include "view/settings.h"

#include <cstdint>

namespace froxel::render {

// (Light, pixel) pairs: under a minute at 9 ns on two cores of a CPU device, and at 70 ps in the
// fragment stage of an H200.
inline constexpr double kMostPairsCpu = 6e9;
inline constexpr double kMostPairsGpu = 5e11;

// Errors: kCapacity where each pixel looping over `lights_each` lights is more than that.
[[nodiscard]] Result<void>
checkLightBudget(const view::Size& size, uint64_t lights_each, bool device_is_cpu);

} // namespace froxel::render

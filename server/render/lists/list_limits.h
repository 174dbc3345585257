// How much the light lists that a device makes may hold.
#pragma once

#include "cluster/light_assigner.h"

#include <cstdint>

namespace froxel::render {

// What the host's lists may hold. It has a tenth of a second for them: so many entries take it, on
// two cores as on sixteen, which wait for memory.
inline constexpr uint64_t kHostListEntries = uint64_t{1} << 23U;

// The defaults start small and grow by need; a test may start smaller.
struct ListLimits {
    uint32_t first_entries = 1U << 18U;
    uint32_t first_tasks = 1U << 16U;
    uint64_t max_entries = cluster::LightAssigner::kDefaultMaxEntries; // beyond: all lights
    // One dispatch makes the lists of a grid in which each can have all lights within so many
    // entries (64 MiB); 0: of none.
    uint32_t line_entries = 1U << 24U;
    // 192 MiB. Beyond, the host assigns: lights so large that their lines alone are too many.
    uint32_t max_tasks = 1U << 22U;
};

} // namespace froxel::render

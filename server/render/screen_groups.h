// Workgroups of screen passes.
#pragma once

#include "interface/constants.h"

#include <cstdint>

namespace froxel::render {

// That cover a side of so many pixels.
[[nodiscard]] constexpr uint32_t screenGroups(uint32_t side_px) {
    return (side_px + io::kScreenGroup - 1) / io::kScreenGroup;
}

} // namespace froxel::render

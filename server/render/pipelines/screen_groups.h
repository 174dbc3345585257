// Workgroups of screen passes.
#pragma once

#include "gpu/vulkan.h"
#include "interface/constants.h"

#include <cstdint>

namespace froxel::render {

// That cover a side of so many pixels.
[[nodiscard]] constexpr uint32_t screenGroups(uint32_t side_px) {
    return (side_px + io::kScreenGroup - 1) / io::kScreenGroup;
}

// Those of a part of the picture, whose corner is a group's.
inline void
dispatchOver(const vk::raii::CommandBuffer& cmd, const vk::Rect2D& region, uint32_t depth = 1) {
    cmd.dispatchBase(static_cast<uint32_t>(region.offset.x) / io::kScreenGroup,
                     static_cast<uint32_t>(region.offset.y) / io::kScreenGroup, 0,
                     screenGroups(region.extent.width), screenGroups(region.extent.height), depth);
}

} // namespace froxel::render

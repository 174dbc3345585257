// For the files that order passes.
#pragma once

#include "gpu/vulkan.h"

namespace froxel::render {

inline constexpr vk::PipelineStageFlags2 kDepthStages =
    vk::PipelineStageFlagBits2::eEarlyFragmentTests |
    vk::PipelineStageFlagBits2::eLateFragmentTests;

// All that was written so -> all that uses it so.
inline void barrier(const vk::raii::CommandBuffer& cmd,
                    vk::PipelineStageFlags2 from,
                    vk::AccessFlags2 written,
                    vk::PipelineStageFlags2 to,
                    vk::AccessFlags2 used) {
    const vk::MemoryBarrier2 memory{
        .srcStageMask = from, .srcAccessMask = written, .dstStageMask = to, .dstAccessMask = used};
    cmd.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &memory});
}

} // namespace froxel::render

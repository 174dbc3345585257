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

// What compute passes so far stored -> loads and stores of those that follow.
inline void nextComputePass(const vk::raii::CommandBuffer& cmd) {
    using Access = vk::AccessFlagBits2;
    using Stage = vk::PipelineStageFlagBits2;
    barrier(cmd, Stage::eComputeShader, Access::eShaderStorageWrite, Stage::eComputeShader,
            Access::eShaderStorageRead | Access::eShaderSampledRead | Access::eShaderStorageWrite);
}

// Likewise, and -> indirect arguments of dispatches and draws.
inline void nextIndirectPass(const vk::raii::CommandBuffer& cmd) {
    using Access = vk::AccessFlagBits2;
    using Stage = vk::PipelineStageFlagBits2;
    barrier(cmd, Stage::eComputeShader, Access::eShaderStorageWrite,
            Stage::eComputeShader | Stage::eDrawIndirect,
            Access::eShaderStorageRead | Access::eShaderStorageWrite |
                Access::eIndirectCommandRead);
}

// What was copied or cleared -> loads and stores of compute passes.
inline void computeAfterTransfer(const vk::raii::CommandBuffer& cmd) {
    using Access = vk::AccessFlagBits2;
    using Stage = vk::PipelineStageFlagBits2;
    barrier(cmd, Stage::eAllTransfer, Access::eTransferWrite, Stage::eComputeShader,
            Access::eShaderStorageRead | Access::eShaderStorageWrite);
}

// What compute passes so far stored -> copies.
inline void copyAfterCompute(const vk::raii::CommandBuffer& cmd) {
    using Access = vk::AccessFlagBits2;
    using Stage = vk::PipelineStageFlagBits2;
    barrier(cmd, Stage::eComputeShader, Access::eShaderStorageWrite, Stage::eCopy,
            Access::eTransferRead);
}

// What raster passes so far wrote and read -> tests, blending and loads of those that follow.
inline void nextRasterPass(const vk::raii::CommandBuffer& cmd) {
    using Access = vk::AccessFlagBits2;
    using Stage = vk::PipelineStageFlagBits2;
    constexpr vk::PipelineStageFlags2 kStages =
        kDepthStages | Stage::eColorAttachmentOutput | Stage::eFragmentShader;
    constexpr vk::AccessFlags2 kWrites =
        Access::eDepthStencilAttachmentWrite | Access::eColorAttachmentWrite;
    barrier(cmd, kStages, kWrites, kStages,
            kWrites | Access::eDepthStencilAttachmentRead | Access::eColorAttachmentRead |
                Access::eShaderSampledRead);
}

} // namespace froxel::render

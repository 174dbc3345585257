#include "render/frame_recorder.h"

#include "render/barrier.h"
#include "render/blended_recorder.h"
#include "render/fog_passes.h"
#include "render/passes.h"
#include "render/raster_passes.h"
#include "render/visibility_passes.h"

#include <utility>
#include <vector>

namespace froxel::render {

namespace {

using Access = vk::AccessFlagBits2;
using Stage = vk::PipelineStageFlagBits2;

constexpr vk::PipelineStageFlags2 kShaders = Stage::eComputeShader | Stage::eFragmentShader;

void recordPrepass(const FrameContext& frame) {
    if (frame.plan.depth_prepass) {
        recordDepthPrepass(frame);
        // prepass depth -> the next pass's equality test
        barrier(frame.slot.cmd, kDepthStages, Access::eDepthStencilAttachmentWrite, kDepthStages,
                Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite);
    }
}

void recordForward(const FrameContext& frame) {
    recordPrepass(frame);
    recordForwardPass(frame);
}

// Depth and ids, rastered in compute.
void recordComputeRaster(const FrameContext& frame) {
    const auto& cmd = frame.slot.cmd;
    const auto next = [&] {
        // a pass's lists, counts and words -> the next one's
        barrier(cmd, Stage::eComputeShader, Access::eShaderStorageWrite,
                Stage::eComputeShader | Stage::eDrawIndirect,
                Access::eShaderStorageRead | Access::eShaderStorageWrite |
                    Access::eIndirectCommandRead);
    };
    recordRasterClear(frame);
    // cleared words and counts -> first use
    barrier(cmd, Stage::eAllTransfer, Access::eTransferWrite, Stage::eComputeShader,
            Access::eShaderStorageRead | Access::eShaderStorageWrite);
    recordRasterCull(frame);
    next();
    recordRasterMeshlets(frame);
    next();
    recordRasterBlocks(frame);
    next();
    recordRasterUnpack(frame);
    // depth and ids -> the pass that shades or fills the G-buffer, which also stores depth anew
    barrier(cmd, Stage::eComputeShader, Access::eShaderStorageWrite, kShaders,
            Access::eShaderSampledRead | Access::eShaderStorageWrite);
}

// Depth and ids; what follows reads them in compute.
void recordVisible(const FrameContext& frame) {
    if (frame.plan.compute_raster) {
        recordComputeRaster(frame);
        return;
    }
    const auto& cmd = frame.slot.cmd;
    if (!frame.scene.device.traits().draw_indirect_count) {
        recordEmptyDraws(frame);
    }
    recordCull(frame);
    // ranks and counts of visible meshlets, empty draws -> compaction's loads and stores
    barrier(cmd, Stage::eComputeShader | Stage::eTransfer,
            Access::eShaderStorageWrite | Access::eTransferWrite, Stage::eComputeShader,
            Access::eShaderStorageRead | Access::eShaderStorageWrite);
    recordCompact(frame);
    // draws and their counts -> indirect draws
    barrier(cmd, Stage::eComputeShader, Access::eShaderStorageWrite, Stage::eDrawIndirect,
            Access::eIndirectCommandRead);
    recordVisibility(frame);
    // depth and ids -> loads of the pass that shades or fills the G-buffer
    barrier(cmd, kDepthStages | Stage::eColorAttachmentOutput,
            Access::eDepthStencilAttachmentWrite | Access::eColorAttachmentWrite,
            Stage::eComputeShader, Access::eShaderSampledRead);
}

// radiance as the last pass left it, in either stage -> loads and stores of a compute pass
void radianceToCompute(const vk::raii::CommandBuffer& cmd) {
    barrier(cmd, Stage::eColorAttachmentOutput | Stage::eComputeShader,
            Access::eColorAttachmentWrite | Access::eShaderStorageWrite, Stage::eComputeShader,
            Access::eShaderStorageRead | Access::eShaderSampledRead | Access::eShaderStorageWrite);
}

// Fills the G-buffer; what follows reads it.
void recordGeometry(const FrameContext& frame) {
    if (frame.plan.visibility) {
        recordVisible(frame);
        recordVisibilityGbuffer(frame);
        // G-buffer, and depth where compute rastered -> lighting's loads
        barrier(frame.slot.cmd, Stage::eComputeShader, Access::eShaderStorageWrite, kShaders,
                Access::eShaderSampledRead);
    } else {
        recordPrepass(frame);
        recordGbuffer(frame);
        // G-buffer and depth -> lighting's loads
        barrier(frame.slot.cmd, kDepthStages | Stage::eColorAttachmentOutput,
                Access::eDepthStencilAttachmentWrite | Access::eColorAttachmentWrite, kShaders,
                Access::eShaderSampledRead);
    }
}

void recordDeferred(const FrameContext& frame) {
    recordGeometry(frame);
    if (frame.plan.lighting_compute) {
        recordLightingCompute(frame);
    } else {
        recordLightingFragment(frame);
    }
    if (frame.plan.toon_pass) {
        radianceToCompute(frame.slot.cmd);
        recordToon(frame);
    }
    if (frame.plan.outline) {
        radianceToCompute(frame.slot.cmd);
        recordOutline(frame);
    }
}

// Solid surfaces and empty pixels, seen through fog.
void recordFog(const FrameContext& frame) {
    const auto& cmd = frame.slot.cmd;
    if (frame.plan.fog_volume) {
        recordFogScatter(frame);
        // the slices' scattering -> their sums, in place
        barrier(cmd, Stage::eComputeShader, Access::eShaderStorageWrite, Stage::eComputeShader,
                Access::eShaderStorageRead | Access::eShaderStorageWrite);
        recordFogIntegrate(frame);
        // the sums -> texel loads of this pass and of blended surfaces
        barrier(cmd, Stage::eComputeShader, Access::eShaderStorageWrite, kShaders,
                Access::eShaderSampledRead);
    }
    // radiance and depth of solid surfaces -> loads and stores
    barrier(cmd, kDepthStages | Stage::eColorAttachmentOutput | kShaders,
            Access::eDepthStencilAttachmentWrite | Access::eColorAttachmentWrite |
                Access::eShaderStorageWrite,
            Stage::eComputeShader,
            Access::eShaderSampledRead | Access::eShaderStorageRead | Access::eShaderStorageWrite);
    recordFogApply(frame);
}

void recordBloom(const FrameContext& frame) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, "bloom");
    for (size_t step = 0; step < frame.bloom->steps.size(); ++step) {
        // the picture, what steps before left -> this one's loads; their loads -> its stores
        radianceToCompute(frame.slot.cmd);
        recordBloomStep(frame.slot.cmd, frame.scene.bloom(), *frame.slot.bloom, *frame.bloom, step);
    }
}

// A debug view in the picture's place, with the surfaces that it shows.
void recordReplacement(const FrameContext& frame) {
    const auto& cmd = frame.slot.cmd;
    if (frame.plan.debug == view::DebugView::kOverdraw) {
        recordOverdraw(frame);
        // counted fragments -> load
        barrier(cmd, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite,
                Stage::eComputeShader, Access::eShaderStorageRead);
    } else if (frame.plan.gbuffer) {
        recordGeometry(frame);
    } else if (frame.plan.visibility) {
        recordVisible(frame);
    } else {
        recordDepthPrepass(frame);
        // depth -> loads
        barrier(cmd, kDepthStages, Access::eDepthStencilAttachmentWrite, Stage::eComputeShader,
                Access::eShaderSampledRead);
    }
    recordDebugView(frame);
}

// Moves fresh images into the GENERAL layout.
void transitionFresh(FrameSlot& slot) {
    std::vector<vk::ImageMemoryBarrier2> barriers;
    const auto add = [&](const gpu::Image& image, vk::ImageAspectFlags aspect) {
        if (*image.handle) {
            barriers.push_back({.dstStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                .dstAccessMask = vk::AccessFlagBits2::eMemoryRead |
                                                 vk::AccessFlagBits2::eMemoryWrite,
                                .oldLayout = vk::ImageLayout::eUndefined,
                                .newLayout = vk::ImageLayout::eGeneral,
                                .image = *image.handle,
                                .subresourceRange = {aspect, 0, 1, 0, 1}});
        }
    };
    ViewTargets& targets = *slot.targets;
    if (std::exchange(targets.fresh, false)) {
        add(targets.depth, vk::ImageAspectFlagBits::eDepth);
        add(targets.gbuffer, vk::ImageAspectFlagBits::eColor);
        add(targets.gbuffer_extra, vk::ImageAspectFlagBits::eColor);
        add(targets.ids, vk::ImageAspectFlagBits::eColor);
        add(targets.compute_depth, vk::ImageAspectFlagBits::eColor);
        add(targets.radiance, vk::ImageAspectFlagBits::eColor);
    }
    if (slot.blend && std::exchange(slot.blend->fresh, false)) {
        add(slot.blend->sums, vk::ImageAspectFlagBits::eColor);
        add(slot.blend->weights, vk::ImageAspectFlagBits::eColor);
        add(slot.blend->layer_depth, vk::ImageAspectFlagBits::eDepth);
        for (const auto& keys : slot.blend->layer_keys) {
            add(keys, vk::ImageAspectFlagBits::eColor);
        }
    }
    if (slot.shadows && std::exchange(slot.shadows->fresh, false)) {
        add(slot.shadows->atlas, vk::ImageAspectFlagBits::eDepth);
    }
    if (slot.bloom && std::exchange(slot.bloom->fresh, false)) {
        for (const auto& image : slot.bloom->images()) {
            add(image, vk::ImageAspectFlagBits::eColor);
        }
    }
    if (!barriers.empty()) {
        slot.cmd.pipelineBarrier2(
            {.imageMemoryBarrierCount = static_cast<uint32_t>(barriers.size()),
             .pImageMemoryBarriers = barriers.data()});
    }
}

void copyImage(const vk::raii::CommandBuffer& cmd,
               const gpu::Image& image,
               vk::ImageAspectFlags aspect,
               const gpu::Buffer& to,
               vk::DeviceSize offset) {
    cmd.copyImageToBuffer(
        *image.handle, vk::ImageLayout::eGeneral, *to.handle,
        vk::BufferImageCopy{.bufferOffset = offset,
                            .imageSubresource = {aspect, 0, 0, 1},
                            .imageExtent = {image.extent.width, image.extent.height, 1}});
}

} // namespace

void recordFrame(const FrameContext& frame) {
    auto& slot = frame.slot;
    slot.cmd.reset();
    slot.cmd.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    slot.timestamps.reset();
    // the view's last frame, which had the same targets -> this one
    barrier(frame.slot.cmd, Stage::eAllCommands, Access::eMemoryWrite, Stage::eAllCommands,
            Access::eMemoryRead | Access::eMemoryWrite);
    transitionFresh(slot);
    if (slot.device_lists) {
        recordAssignment({slot.cmd, *frame.scene.assignment(), *slot.assignment}, slot.timestamps);
    }
    if (frame.plan.shadows) {
        recordShadows(frame);
        // depths as lights see them -> lighting's loads
        barrier(slot.cmd, kDepthStages, Access::eDepthStencilAttachmentWrite, kShaders,
                Access::eShaderSampledRead);
    }

    if (view::replacesPicture(frame.plan.debug)) {
        recordReplacement(frame);
    } else if (frame.plan.visibility_shade) {
        recordVisible(frame);
        recordVisibilityShade(frame);
    } else if (frame.plan.forward) {
        recordForward(frame);
    } else {
        recordDeferred(frame);
    }
    if (frame.plan.count_pairs) {
        slot.pairs->recordClear(slot.cmd);
        // cleared counters, depth -> counting
        barrier(slot.cmd, Stage::eClear | kDepthStages | Stage::eComputeShader,
                Access::eTransferWrite | Access::eDepthStencilAttachmentWrite |
                    Access::eShaderStorageWrite,
                Stage::eComputeShader,
                Access::eShaderStorageRead | Access::eShaderStorageWrite |
                    Access::eShaderSampledRead);
        recordCountPairs(frame);
    }
    if (frame.plan.fog) {
        recordFog(frame);
    }
    if (frame.plan.transparent) {
        recordBlended(frame);
    }
    if (frame.bloom != nullptr) {
        recordBloom(frame);
    }
    if (view::isOverlay(frame.plan.debug)) {
        // the picture's radiance and depth -> blending, loads
        barrier(frame.slot.cmd, kDepthStages | Stage::eColorAttachmentOutput | kShaders,
                Access::eDepthStencilAttachmentWrite | Access::eColorAttachmentWrite |
                    Access::eShaderStorageWrite,
                Stage::eColorAttachmentOutput | Stage::eFragmentShader,
                Access::eColorAttachmentRead | Access::eColorAttachmentWrite |
                    Access::eShaderSampledRead);
        recordWires(frame);
    }
    if (frame.plan.tonemap) {
        radianceToCompute(frame.slot.cmd);
        recordTonemap(frame);
    }
    if (frame.plan.fxaa) {
        // packed pixels -> the filter's loads
        barrier(frame.slot.cmd, Stage::eComputeShader, Access::eShaderStorageWrite,
                Stage::eComputeShader, Access::eShaderSampledRead);
        recordFxaa(frame);
    }
    if (slot.targets->needs.device_pixels) {
        // packed pixels -> copy
        barrier(frame.slot.cmd, Stage::eComputeShader, Access::eShaderStorageWrite, Stage::eCopy,
                Access::eTransferRead);
        recordReadback(frame);
    }
    recordHostRead(slot.cmd); // pixels and counters
    slot.cmd.end();
}

void recordHostRead(const vk::raii::CommandBuffer& cmd) {
    barrier(cmd, Stage::eComputeShader | Stage::eCopy,
            Access::eShaderStorageWrite | Access::eTransferWrite, Stage::eHost, Access::eHostRead);
}

void recordAssignment(const AssignContext& assign, gpu::Timestamps& timestamps) {
    const auto& cmd = assign.cmd;
    const auto next = [&] {
        // a pass's buffers and indirect arguments -> the next one's
        barrier(cmd, Stage::eComputeShader, Access::eShaderStorageWrite,
                Stage::eComputeShader | Stage::eDrawIndirect,
                Access::eShaderStorageRead | Access::eShaderStorageWrite |
                    Access::eIndirectCommandRead);
    };
    {
        const gpu::PassScope scope(timestamps, cmd, "assign_count");
        recordAssignClear(assign);
        // cleared counters -> first use
        barrier(cmd, Stage::eAllTransfer, Access::eTransferWrite, Stage::eComputeShader,
                Access::eShaderStorageRead | Access::eShaderStorageWrite);
        recordAssignBound(assign);
        next();
        recordAssignCount(assign);
        next();
    }
    {
        const gpu::PassScope scope(timestamps, cmd, "assign_scan");
        recordAssignSum(assign);
        next();
        recordAssignPlace(assign);
        next();
    }
    {
        const gpu::PassScope scope(timestamps, cmd, "assign_fill");
        recordAssignFill(assign);
        next();
    }
    const gpu::PassScope scope(timestamps, cmd, "assign_order");
    recordAssignOrder(assign);
    // lists and indices -> shading; counters -> copy
    barrier(cmd, Stage::eComputeShader, Access::eShaderStorageWrite, kShaders | Stage::eCopy,
            Access::eShaderRead | Access::eTransferRead);
    recordAssignCopy(assign);
}

void recordTargetCopy(const vk::raii::CommandBuffer& cmd,
                      const gpu::Image& target,
                      vk::ImageAspectFlags aspect,
                      const gpu::Buffer& to) {
    // the frame's last write of the target -> copy
    barrier(cmd, Stage::eAllCommands, Access::eMemoryWrite, Stage::eCopy, Access::eTransferRead);
    copyImage(cmd, target, aspect, to, 0);
    // copy -> host
    barrier(cmd, Stage::eCopy, Access::eTransferWrite, Stage::eHost, Access::eHostRead);
}

void recordVisibilityCopy(const vk::raii::CommandBuffer& cmd,
                          const ViewTargets& targets,
                          const gpu::Buffer& to) {
    // the frame's last writes of ids and depth -> copies
    barrier(cmd, Stage::eAllCommands, Access::eMemoryWrite, Stage::eCopy, Access::eTransferRead);
    copyImage(cmd, targets.ids, vk::ImageAspectFlagBits::eColor, to, 0);
    copyImage(cmd, targets.solidDepth(),
              targets.rastered_in_compute ? vk::ImageAspectFlagBits::eColor
                                          : vk::ImageAspectFlagBits::eDepth,
              to, vk::DeviceSize{4} * targets.size.width_px * targets.size.height_px);
    // copies -> host
    barrier(cmd, Stage::eCopy, Access::eTransferWrite, Stage::eHost, Access::eHostRead);
}

} // namespace froxel::render

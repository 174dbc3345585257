#include "render/frame_recorder.h"

#include "render/blended_recorder.h"
#include "render/frame/pass_names.h"
#include "render/fresh_targets.h"
#include "render/pipelines/barrier.h"
#include "render/pipelines/host_copies.h"
#include "render/surfaces/passes.h"
#include "render/surfaces/raster_passes.h"
#include "render/surfaces/visibility_passes.h"

#include <utility>

namespace froxel::render {

namespace {

using Access = vk::AccessFlagBits2;
using Stage = vk::PipelineStageFlagBits2;

constexpr vk::PipelineStageFlags2 kShaders = Stage::eComputeShader | Stage::eFragmentShader;

const settings::Size& drawn(const FrameContext& frame) {
    return frame.slot.targets->size;
}

const settings::Size& shown(const FrameContext& frame) {
    return frame.slot.targets->shown;
}

vk::Rect2D whole(const FrameContext& frame) {
    return {{0, 0}, {drawn(frame).width_px, drawn(frame).height_px}};
}

// The frame's vertices over those of the view's frame before.
void recordPose(const FrameContext& frame) {
    constexpr vk::PipelineStageFlags2 kReaders =
        Stage::eVertexAttributeInput | Stage::eVertexShader | kShaders;
    const auto& cmd = frame.slot.cmd;
    frame.pieces.add(frame.costs.pose());
    if (std::exchange(frame.slot.posed->fresh, false)) {
        // After whatever still reads or writes them, of frames before one that was given up.
        barrier(cmd, kReaders | Stage::eCopy, Access::eShaderStorageWrite | Access::eTransferWrite,
                Stage::eCopy, Access::eTransferWrite);
        frame.slot.posed->recordRest(cmd, frame.scene);
    }
    // loads of the frame before, vertices at rest -> stores
    barrier(cmd, kReaders | Stage::eCopy, Access::eTransferWrite, Stage::eComputeShader,
            Access::eShaderStorageWrite);
    recordPoseVertices(frame);
    if (frame.scene.poser()->flat) {
        // positions, normals -> normals of moved triangles
        barrier(cmd, Stage::eComputeShader, Access::eShaderStorageWrite, Stage::eComputeShader,
                Access::eShaderStorageRead | Access::eShaderStorageWrite);
        recordPoseFlatNormals(frame);
    }
    // vertices -> whatever draws or shades them
    barrier(cmd, Stage::eCopy | Stage::eComputeShader,
            Access::eTransferWrite | Access::eShaderStorageWrite, kReaders,
            Access::eVertexAttributeRead | Access::eShaderStorageRead);
}

void recordPrepass(const FrameContext& frame) {
    if (frame.plan.depth_prepass && !frame.plan.reused) {
        inParts(frame, drawn(frame), frame.costs.depthPrepass(), recordDepthPrepass);
        // prepass depth -> the next pass's equality test
        barrier(frame.slot.cmd, kDepthStages, Access::eDepthStencilAttachmentWrite, kDepthStages,
                Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite);
    }
}

void recordForward(const FrameContext& frame) {
    recordPrepass(frame);
    inParts(frame, drawn(frame), frame.costs.forward(), recordForwardPass);
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

// Likewise by the rasteriser, of a part of the picture.
void recordVisiblePart(const FrameContext& frame, const vk::Rect2D& region) {
    const auto& cmd = frame.slot.cmd;
    // draws of the part before -> this one's
    barrier(cmd, Stage::eDrawIndirect | Stage::eComputeShader, Access::eShaderStorageWrite,
            Stage::eComputeShader | Stage::eTransfer,
            Access::eShaderStorageWrite | Access::eTransferWrite);
    if (!frame.scene.shared.device.traits().draw_indirect_count) {
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
    recordVisibility(frame, region);
    // depth and ids -> loads of the pass that shades or fills the G-buffer
    barrier(cmd, kDepthStages | Stage::eColorAttachmentOutput,
            Access::eDepthStencilAttachmentWrite | Access::eColorAttachmentWrite,
            Stage::eComputeShader, Access::eShaderSampledRead);
}

// Depth and ids; what follows reads them in compute.
void recordVisible(const FrameContext& frame) {
    if (frame.plan.reused) {
        return;
    }
    if (frame.plan.compute_raster) {
        const RegionCost cost = frame.costs.ids();
        frame.pieces.add(cost.each + cost.of(whole(frame)));
        recordComputeRaster(frame);
        return;
    }
    // Views share the lists of visible meshlets: each part makes its own.
    inParts(frame, drawn(frame), frame.costs.ids(), recordVisiblePart);
}

// radiance as the last pass left it, in either stage -> loads and stores of a compute pass
void radianceToCompute(const vk::raii::CommandBuffer& cmd) {
    barrier(cmd, Stage::eColorAttachmentOutput | Stage::eComputeShader,
            Access::eColorAttachmentWrite | Access::eShaderStorageWrite, Stage::eComputeShader,
            Access::eShaderStorageRead | Access::eShaderSampledRead | Access::eShaderStorageWrite);
}

// Fills the G-buffer; what follows reads it.
void recordGeometry(const FrameContext& frame) {
    if (frame.plan.reused) {
        return; // the frame that drew it has the barriers
    }
    if (frame.plan.visibility) {
        recordVisible(frame);
        inParts(frame, drawn(frame), frame.costs.resolve(), recordVisibilityGbuffer);
        // G-buffer, and depth, which compute has waited for -> lighting's loads and depth test
        barrier(frame.slot.cmd, Stage::eComputeShader, Access::eShaderStorageWrite,
                kShaders | kDepthStages,
                Access::eShaderSampledRead | Access::eDepthStencilAttachmentRead);
    } else {
        recordPrepass(frame);
        inParts(frame, drawn(frame), frame.costs.gbuffer(), recordGbuffer);
        // G-buffer and depth -> lighting's loads and depth test
        barrier(frame.slot.cmd, kDepthStages | Stage::eColorAttachmentOutput,
                Access::eDepthStencilAttachmentWrite | Access::eColorAttachmentWrite,
                kShaders | kDepthStages,
                Access::eShaderSampledRead | Access::eDepthStencilAttachmentRead);
    }
}

void recordDeferred(const FrameContext& frame) {
    recordGeometry(frame);
    inParts(frame, drawn(frame), frame.costs.lighting(),
            frame.plan.lighting_compute ? recordLightingCompute : recordLightingFragment);
    if (frame.plan.layers && frame.plan.visibility) {
        radianceToCompute(frame.slot.cmd);
        inParts(frame, drawn(frame), frame.costs.layers(), recordVisibilityLayers);
    } else if (frame.plan.layers) {
        // lit radiance, depth that lighting read -> stores, depth test
        barrier(frame.slot.cmd, kDepthStages | Stage::eColorAttachmentOutput | kShaders,
                Access::eColorAttachmentWrite | Access::eShaderStorageWrite,
                kDepthStages | Stage::eColorAttachmentOutput,
                Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite |
                    Access::eColorAttachmentRead | Access::eColorAttachmentWrite);
        inParts(frame, drawn(frame), frame.costs.layers(), recordLayers);
    }
    if (frame.plan.toon_pass) {
        radianceToCompute(frame.slot.cmd);
        inParts(frame, drawn(frame), frame.costs.screen(), recordToon);
    }
    if (frame.plan.outline) {
        radianceToCompute(frame.slot.cmd);
        inParts(frame, drawn(frame), frame.costs.screen(), recordOutline);
    }
}

// Effects of a place; before() has what lies between the picture and what each does to it.
template <class Before>
void recordEffects(const FrameContext& frame, EffectPlace place, const Before& before) {
    for (const auto& [at, effect] : frame.effects) {
        if (at == place) {
            effect->recordOwn(frame);
            before();
            effect->record(frame);
        }
    }
}

// A debug view in the picture's place, with the surfaces that it shows.
void recordReplacement(const FrameContext& frame) {
    const auto& cmd = frame.slot.cmd;
    if (frame.plan.debug == settings::DebugView::kOverdraw) {
        inParts(frame, drawn(frame), frame.costs.gbuffer(), recordOverdraw);
        // counted fragments -> load
        barrier(cmd, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite,
                Stage::eComputeShader, Access::eShaderStorageRead);
    } else if (frame.plan.gbuffer) {
        recordGeometry(frame);
    } else if (frame.plan.visibility) {
        recordVisible(frame);
    } else if (!frame.plan.reused) {
        inParts(frame, drawn(frame), frame.costs.depthPrepass(), recordDepthPrepass);
        // depth -> loads
        barrier(cmd, kDepthStages, Access::eDepthStencilAttachmentWrite, Stage::eComputeShader,
                Access::eShaderSampledRead);
    }
    inParts(frame, drawn(frame), frame.costs.debugView(), recordDebugView);
}

// Lines over the lit picture. Later lights' blend over those before.
void recordOverlay(const FrameContext& frame) {
    const bool spheres = frame.plan.debug == settings::DebugView::kLightSpheres;
    const auto total =
        spheres ? frame.debug->light_count : static_cast<uint32_t>(frame.debug->wires.size() / 2);
    const Seconds each = frame.costs.wires(spheres ? io::kLinesOfALight : 1);
    const auto at_once = static_cast<uint32_t>(std::min<size_t>(frame.pieces.fits(each), total));
    for (uint32_t first = 0; first < total; first += at_once) {
        const uint32_t count = std::min(at_once, total - first);
        frame.pieces.add(count * each);
        if (spheres) {
            recordLightWires(frame, first, count);
        } else {
            recordClusterWires(frame, first, count);
        }
        // lines so far -> those blended over them
        barrier(frame.slot.cmd, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite,
                Stage::eColorAttachmentOutput,
                Access::eColorAttachmentRead | Access::eColorAttachmentWrite);
    }
}

// Between a frame and the next one of the view, which has no pass that draws surfaces to come
// between: what that one loaded, stored and copied -> what this one does.
void recordReused(const vk::raii::CommandBuffer& cmd) {
    constexpr vk::PipelineStageFlags2 kAll =
        kShaders | kDepthStages | Stage::eColorAttachmentOutput | Stage::eCopy;
    constexpr vk::AccessFlags2 kWrites =
        Access::eShaderStorageWrite | Access::eColorAttachmentWrite |
        Access::eDepthStencilAttachmentWrite | Access::eTransferWrite;
    barrier(cmd, kAll, kWrites, kAll,
            kWrites | Access::eShaderSampledRead | Access::eShaderStorageRead |
                Access::eColorAttachmentRead | Access::eDepthStencilAttachmentRead |
                Access::eTransferRead);
}

// What there is to see, solid, or what a debug view shows in its place.
void recordSurfaces(const FrameContext& frame) {
    if (frame.plan.reused) {
        recordReused(frame.slot.cmd);
    }
    if (frame.plan.spoil_scratch) {
        // the frame before -> fill -> whatever loads or copies
        barrier(frame.slot.cmd, Stage::eAllCommands, {}, Stage::eAllTransfer, {});
        recordRasterSpoil(frame);
        barrier(frame.slot.cmd, Stage::eAllTransfer, Access::eTransferWrite, Stage::eAllCommands,
                Access::eMemoryRead | Access::eMemoryWrite);
    }
    if (settings::replacesPicture(frame.plan.debug)) {
        recordReplacement(frame);
    } else if (frame.plan.visibility_shade) {
        recordVisible(frame);
        inParts(frame, drawn(frame), frame.costs.resolve(), recordVisibilityShade);
    } else if (frame.plan.forward) {
        recordForward(frame);
    } else {
        recordDeferred(frame);
    }
}

void recordPairs(const FrameContext& frame) {
    auto& slot = frame.slot;
    slot.pairs->recordClear(slot.cmd);
    // cleared counters, depth -> counting
    barrier(slot.cmd, Stage::eAllTransfer | kDepthStages | Stage::eComputeShader,
            Access::eTransferWrite | Access::eDepthStencilAttachmentWrite |
                Access::eShaderStorageWrite,
            Stage::eComputeShader,
            Access::eShaderStorageRead | Access::eShaderStorageWrite | Access::eShaderSampledRead);
    inParts(frame, drawn(frame), frame.costs.countPairs(), recordCountPairs);
}

void recordLists(const FrameContext& frame) {
    frame.pieces.add(frame.costs.assign());
    recordAssignment({frame.slot.cmd, *frame.scene.shared.assignment(), *frame.slot.assignment},
                     frame.slot.timestamps);
}

// Pixels, radiance and counters.
void recordToHost(const FrameContext& frame) {
    const auto& slot = frame.slot;
    if (slot.targets->needs.device_pixels) {
        // packed pixels -> copy
        barrier(slot.cmd, Stage::eComputeShader, Access::eShaderStorageWrite, Stage::eCopy,
                Access::eTransferRead);
        frame.pieces.add(frame.costs.pixelsToHost());
        recordReadback(frame);
    }
    if (*slot.readback->radiance.handle) {
        // radiance as the last pass left it -> copies
        barrier(slot.cmd, Stage::eColorAttachmentOutput | Stage::eComputeShader,
                Access::eColorAttachmentWrite | Access::eShaderStorageWrite, Stage::eCopy,
                Access::eTransferRead);
        inParts(frame, drawn(frame), FrameCosts::radianceToHost(), recordRadianceReadback);
        // copies -> whatever the next frame does to radiance
        barrier(slot.cmd, Stage::eCopy, Access::eNone, Stage::eAllCommands, Access::eNone);
    }
    recordHostRead(slot.cmd);
}

} // namespace

void recordFrame(const FrameContext& frame, Seconds piece_limit, double piece_share) {
    auto& slot = frame.slot;
    frame.pieces.begin(piece_limit, piece_share);
    slot.timestamps.reset();
    recordFreshTargets(slot);
    if (frame.plan.pose && !frame.plan.pose_reused) {
        recordPose(frame);
    }
    if (frame.plan.count_samples) {
        slot.samples->restart();
    }
    if (slot.device_lists) {
        recordLists(frame);
    }
    recordEffects(frame, EffectPlace::kLights, [] {}); // there is no picture yet
    recordSurfaces(frame);
    if (frame.plan.count_pairs) {
        recordPairs(frame);
    }
    recordEffects(frame, EffectPlace::kSolid, [&] {
        // radiance and depth of solid surfaces -> loads and stores
        barrier(slot.cmd, kDepthStages | Stage::eColorAttachmentOutput | kShaders,
                Access::eDepthStencilAttachmentWrite | Access::eColorAttachmentWrite |
                    Access::eShaderStorageWrite,
                Stage::eComputeShader,
                Access::eShaderSampledRead | Access::eShaderStorageRead |
                    Access::eShaderStorageWrite);
    });
    if (frame.plan.transparent) {
        recordBlended(frame);
    }
    recordEffects(frame, EffectPlace::kPicture, [&] { radianceToCompute(slot.cmd); });
    if (settings::isOverlay(frame.plan.debug)) {
        // the picture's radiance and depth -> blending, loads
        barrier(frame.slot.cmd, kDepthStages | Stage::eColorAttachmentOutput | kShaders,
                Access::eDepthStencilAttachmentWrite | Access::eColorAttachmentWrite |
                    Access::eShaderStorageWrite,
                Stage::eColorAttachmentOutput | Stage::eFragmentShader,
                Access::eColorAttachmentRead | Access::eColorAttachmentWrite |
                    Access::eShaderSampledRead);
        recordOverlay(frame);
    }
    if (frame.plan.tonemap) {
        radianceToCompute(frame.slot.cmd);
        inParts(frame, shown(frame), frame.costs.screen(), recordTonemap);
    }
    recordEffects(frame, EffectPlace::kPixels, [&] {
        // packed pixels -> the filter's loads
        barrier(frame.slot.cmd, Stage::eComputeShader, Access::eShaderStorageWrite,
                Stage::eComputeShader, Access::eShaderSampledRead);
    });
    recordToHost(frame);
    frame.pieces.end();
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
    const auto finish = [&] {
        // lists and indices -> shading; lists or counters -> copy
        barrier(cmd, Stage::eComputeShader, Access::eShaderStorageWrite, kShaders | Stage::eCopy,
                Access::eShaderRead | Access::eTransferRead);
        recordAssignCopy(assign);
    };
    if (assign.slot.inLines()) {
        const gpu::PassScope scope(timestamps, cmd, pass::kAssignLines);
        recordAssignLines(assign);
        finish();
        return;
    }
    {
        const gpu::PassScope scope(timestamps, cmd, pass::kAssignCount);
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
        const gpu::PassScope scope(timestamps, cmd, pass::kAssignScan);
        recordAssignSum(assign);
        next();
        recordAssignPlace(assign);
        next();
    }
    {
        const gpu::PassScope scope(timestamps, cmd, pass::kAssignFill);
        recordAssignFill(assign);
        next();
    }
    const gpu::PassScope scope(timestamps, cmd, pass::kAssignOrder);
    recordAssignOrder(assign);
    finish();
}

} // namespace froxel::render

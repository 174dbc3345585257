#include "render/blended_recorder.h"

#include "render/frame/pass_names.h"
#include "render/pipelines/barrier.h"
#include "render/surfaces/blended_passes.h"
#include "render/surfaces/passes.h"
#include "render/surfaces/raster_passes.h"

#include <algorithm>

namespace froxel::render {

namespace {

using Access = vk::AccessFlagBits2;
using Stage = vk::PipelineStageFlagBits2;

constexpr vk::PipelineStageFlags2 kRasterStages =
    kDepthStages | Stage::eColorAttachmentOutput | Stage::eFragmentShader;
constexpr vk::AccessFlags2 kRasterWrites =
    Access::eDepthStencilAttachmentWrite | Access::eColorAttachmentWrite;
constexpr vk::AccessFlags2 kRasterUses =
    kRasterWrites | Access::eDepthStencilAttachmentRead | Access::eColorAttachmentRead;

// Solid depth that compute rastered -> the rasteriser's.
void recordDepthHandover(const FrameContext& frame) {
    const auto& cmd = frame.slot.cmd;
    // depth from compute, words no longer read -> copy by way of the words' buffer
    barrier(cmd, Stage::eComputeShader, Access::eShaderStorageWrite, Stage::eCopy,
            Access::eTransferRead | Access::eTransferWrite);
    recordDepthOut(frame);
    // first copy -> second
    barrier(cmd, Stage::eCopy, Access::eTransferWrite, Stage::eCopy, Access::eTransferRead);
    recordDepthIn(frame);
    // copied depth -> depth test
    barrier(cmd, Stage::eCopy, Access::eTransferWrite, kDepthStages,
            Access::eDepthStencilAttachmentRead | Access::eDepthStencilAttachmentWrite);
}

// what a raster pass wrote and read -> the next one's tests, blending and loads
void nextRasterPass(const vk::raii::CommandBuffer& cmd) {
    barrier(cmd, kRasterStages, kRasterWrites, kRasterStages,
            kRasterUses | Access::eShaderSampledRead);
}

// What was blended apart, over the solid picture; leaves radiance as a colour attachment's writes.
void recordResolve(const FrameContext& frame) {
    const auto& size = frame.slot.targets->size;
    if (!frame.plan.over_unlit) {
        inParts(frame, size, frame.costs.screen(), recordBlendResolve);
        return;
    }
    const auto& cmd = frame.slot.cmd;
    // blended sums, solid radiance -> loads and stores of a compute pass
    barrier(cmd, Stage::eColorAttachmentOutput, Access::eColorAttachmentWrite,
            Stage::eComputeShader,
            Access::eShaderSampledRead | Access::eShaderStorageRead | Access::eShaderStorageWrite);
    inParts(frame, size, frame.costs.screen(), recordBlendOverUnlit);
    // stored radiance -> what takes it for a colour attachment's
    barrier(cmd, Stage::eComputeShader, Access::eShaderStorageWrite, Stage::eColorAttachmentOutput,
            Access::eColorAttachmentRead | Access::eColorAttachmentWrite);
}

void recordPeeled(const FrameContext& frame) {
    const auto& size = frame.slot.targets->size;
    const RegionCost cost = frame.costs.blended();
    const uint32_t layers = peelLayers(frame.plan, frame.draws);
    for (uint32_t layer = 0; layer < layers; ++layer) {
        inParts(frame, size, cost, [layer](const FrameContext& at, const vk::Rect2D& part) {
            const gpu::PassScope scope(at.slot.timestamps, at.slot.cmd, pass::kPeel);
            recordPeelSelect(at, part, layer);
            nextRasterPass(at.slot.cmd);
            recordPeelShade(at, part, layer);
            nextRasterPass(at.slot.cmd);
        });
    }
    if (countsOverflow(frame.plan, frame.draws)) {
        frame.slot.overflow->restart();
        inParts(frame, size, cost, [layers](const FrameContext& at, const vk::Rect2D& part) {
            recordPeelCount(at, part, layers);
        });
    }
    if (layers > 0) {
        recordResolve(frame);
    }
}

} // namespace

uint32_t peelLayers(const FramePlan& plan, const DrawList& draws) {
    return std::min(plan.peel_layers, draws.transparent_triangle_count);
}

bool countsOverflow(const FramePlan& plan, const DrawList& draws) {
    return plan.peel_layers > 0 && draws.transparent_triangle_count > plan.peel_layers;
}

void recordBlended(const FrameContext& frame) {
    const bool peeled = frame.plan.transparency == settings::Transparency::kPeeled;
    if (frame.plan.compute_raster && !peeled) { // which only loads solid depth
        recordDepthHandover(frame);
    }
    // solid surfaces' radiance and depth -> blending, depth test and loads
    barrier(frame.slot.cmd, kRasterStages | Stage::eComputeShader,
            kRasterWrites | Access::eShaderStorageWrite, kRasterStages,
            kRasterUses | Access::eShaderSampledRead);
    const auto& size = frame.slot.targets->size;
    switch (frame.plan.transparency) {
    case settings::Transparency::kSorted:
        inParts(frame, size, frame.costs.blended(), recordTransparent);
        if (frame.plan.over_unlit) {
            recordResolve(frame);
        }
        break;
    case settings::Transparency::kWeighted:
        inParts(frame, size, frame.costs.blended(), recordWeighted);
        nextRasterPass(frame.slot.cmd);
        recordResolve(frame);
        break;
    case settings::Transparency::kPeeled:
        recordPeeled(frame);
        break;
    }
}

} // namespace froxel::render

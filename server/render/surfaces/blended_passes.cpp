#include "render/surfaces/blended_passes.h"

#include "render/frame/pass_names.h"
#include "render/pipelines/screen_groups.h"
#include "render/surfaces/geometry_draws.h"
#include "render/surfaces/rendering_scope.h"

#include <array>

namespace froxel::render {

namespace {

using LoadOp = vk::AttachmentLoadOp;

vk::ClearValue clearColor(float rgb, float alpha) {
    return vk::ClearColorValue(std::array{rgb, rgb, rgb, alpha});
}

void bindLayer(const FrameContext& frame, vk::DescriptorSet set) {
    frame.slot.cmd.bindDescriptorSets(vk::PipelineBindPoint::eGraphics,
                                      frame.scene.shared.pipelines.peelPipelineLayout(), 2, set,
                                      {});
}

} // namespace

void recordWeighted(const FrameContext& frame, const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kWeighted);
    const auto& targets = *frame.slot.blend;
    const std::array colors = {attachment(targets.sums, LoadOp::eClear, clearColor(0, 1)),
                               attachment(targets.weights, LoadOp::eClear, clearColor(0, 0))};
    const auto depth = attachment(frame.slot.targets->depth, LoadOp::eLoad);
    const Rendering rendering(frame, region, colors, &depth);
    drawGroups(frame, GeometryPass::kWeighted, frame.draws.transparent);
}

void recordPeelSelect(const FrameContext& frame, const vk::Rect2D& region, uint32_t layer) {
    const auto& targets = *frame.slot.blend;
    const vk::ClearValue none = vk::ClearColorValue(std::array<uint32_t, 4>{});
    const std::array colors = {
        attachment(targets.layer_keys[layer % targets.layer_keys.size()], LoadOp::eClear, none)};
    const auto depth = attachment(targets.layer_depth, LoadOp::eClear, farDepth());
    const Rendering rendering(frame, region, colors, &depth);
    bindLayer(frame, targets.selectSet(layer));
    drawGroups(frame, GeometryPass::kPeelSelect, frame.draws.transparent, layer);
}

void recordPeelShade(const FrameContext& frame, const vk::Rect2D& region, uint32_t layer) {
    const auto& targets = *frame.slot.blend;
    const std::array colors = {
        attachment(targets.sums, layer == 0 ? LoadOp::eClear : LoadOp::eLoad, clearColor(0, 0))};
    const auto depth = attachment(targets.layer_depth, LoadOp::eLoad);
    const Rendering rendering(frame, region, colors, &depth);
    bindLayer(frame, targets.selectedSet(layer));
    drawGroups(frame, GeometryPass::kPeelShade, frame.draws.transparent, layer);
}

void recordPeelCount(const FrameContext& frame, const vk::Rect2D& region, uint32_t layers) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kPeelCount);
    frame.slot.overflow->begin(frame.slot.cmd);
    {
        const auto depth = attachment(frame.slot.blend->layer_depth, LoadOp::eClear, farDepth());
        const Rendering rendering(frame, region, {}, &depth);
        bindLayer(frame, frame.slot.blend->selectSet(layers));
        drawGroups(frame, GeometryPass::kPeelCount, frame.draws.transparent, layers);
    }
    frame.slot.overflow->end(frame.slot.cmd);
}

void recordBlendResolve(const FrameContext& frame, const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kBlendResolve);
    const auto& cmd = frame.slot.cmd;
    const auto& pipelines = frame.scene.shared.pipelines;
    const std::array colors = {attachment(frame.slot.targets->radiance, LoadOp::eLoad)};
    const Rendering rendering(frame, region, colors, nullptr);
    cmd.bindPipeline(vk::PipelineBindPoint::eGraphics,
                     frame.scene.shared.pipelines.blendResolve(frame.plan.transparency));
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, pipelines.blendResolveLayout(), 0,
                           frame.slot.blend->resolveSet(), {});
    cmd.setCullMode(vk::CullModeFlagBits::eNone);
    cmd.setFrontFace(vk::FrontFace::eCounterClockwise);
    cmd.draw(3, 1, 0, 0);
}

void recordBlendOverUnlit(const FrameContext& frame, const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kBlendOverUnlit);
    const auto& cmd = frame.slot.cmd;
    auto& pipelines = frame.scene.shared.pipelines;
    cmd.bindPipeline(
        vk::PipelineBindPoint::eCompute,
        pipelines.blendOverUnlit(frame.plan.transparency, frame.plan.tone_output_flags));
    const std::array sets = {*frame.slot.frame_set, *frame.slot.screen_set,
                             frame.slot.blend->resolveSet()};
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, pipelines.blendOverUnlitLayout(), 0,
                           sets, {});
    dispatchOver(cmd, region);
}

} // namespace froxel::render

// What the compute passes of the visibility path bind, whatever rasters.
#pragma once

#include "render/frame/frame_context.h"
#include "render/frame/posed_targets.h"
#include "render/scene/visibility_scene.h"

#include <array>

namespace froxel::render {

// What the slot's frame binds whichever surfaces it draws; nothing draws them yet.
[[nodiscard]] inline VisibilityFrame::Bindings
visibilityBindings(const SceneResources& resources, VisibilityScene& scene, const FrameSlot& slot) {
    const ViewTargets& targets = *slot.targets;
    return {.resources = resources,
            .scene = scene,
            .vertices = vertexBuffers(resources, slot),
            .instances = {slot.upload.buffer(), slot.offsets.instances,
                          resources.instances.size() * sizeof(io::InstanceView)},
            .order = {.range = VK_WHOLE_SIZE},
            .ids = *targets.ids.view,
            .gbuffer = *targets.ids.view,
            .depth = *targets.compute_depth.view};
}

[[nodiscard]] inline vk::DescriptorSet visibilitySet(const FrameContext& frame) {
    return frame.visibility->surfaces == Surfaces::kSolid
               ? frame.slot.stored.get<VisibilityFrame>().set()
               : frame.slot.stored.get<TransmissiveFrame>().set();
}

// The pipeline with sets 0 to 2: frame, screen, visibility.
inline void bindVisibilityCompute(const FrameContext& frame, vk::Pipeline pipeline) {
    const auto& cmd = frame.slot.cmd;
    cmd.bindPipeline(vk::PipelineBindPoint::eCompute, pipeline);
    const std::array sets = {*frame.slot.frame_set, *frame.slot.screen_set, visibilitySet(frame)};
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute,
                           frame.visibility->pipelines.computeLayout(), 0, sets, {});
}

inline void pushVisibilityWords(const FrameContext& frame, const std::array<uint32_t, 2>& words) {
    frame.slot.cmd.pushConstants<uint32_t>(frame.visibility->pipelines.computeLayout(),
                                           vk::ShaderStageFlagBits::eCompute, 0, words);
}

// A workgroup for each tile of a layer (shaders/lib/layer_tiles.glsl).
inline void dispatchTiles(const FrameContext& frame, vk::Buffer tiles, uint32_t layer) {
    if (frame.scene.shared.device.traits().is_cpu) {
        // lavapipe 22.3 adds the base of the last dispatch, which this one sets to 0.
        frame.slot.cmd.dispatch(0, 0, 0);
    }
    frame.slot.cmd.dispatchIndirect(tiles, vk::DeviceSize{4} * layer * sizeof(uint32_t));
}

// A culling pass over all placed meshlets; culls: not of all.
inline void dispatchCull(const FrameContext& frame, vk::Pipeline pipeline, bool culls) {
    const auto& scene = *frame.visibility;
    bindVisibilityCompute(frame, pipeline);
    const uint32_t flags = (culls ? 0U : io::kKeepAll) | (scene.ordered() ? io::kOrdered : 0U);
    pushVisibilityWords(frame, {flags, static_cast<uint32_t>(scene.groups.size())});
    frame.slot.cmd.dispatch(scene.block_count, 1, 1);
}

} // namespace froxel::render

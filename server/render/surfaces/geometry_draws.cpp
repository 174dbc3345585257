#include "render/surfaces/geometry_draws.h"

#include "interface/constants.h"
#include "interface/debug_io.h"
#include "interface/peel_io.h"
#include "render/frame/posed_targets.h"

#include <array>

namespace froxel::render {

void bindGeometry(const FrameContext& frame,
                  vk::PipelineLayout layout,
                  vk::DescriptorSet frame_set,
                  vk::Buffer indices,
                  vk::DeviceSize rows) {
    const auto& cmd = frame.slot.cmd;
    const VertexBuffers vertices = vertexBuffers(frame.scene, frame.slot);
    const std::array buffers = {vertices.positions, vertices.surfaces,
                                vertices.extended, // none: no pipeline reads it
                                frame.slot.upload.buffer()};
    const std::array<vk::DeviceSize, 4> offsets = {0, 0, 0, rows};
    cmd.bindVertexBuffers(0, buffers, offsets);
    cmd.bindIndexBuffer(indices, 0, vk::IndexType::eUint32);
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, layout, 0, frame_set, {});
}

namespace {

// What is blended and unlit looks at the tone map.
uint32_t toneOf(const FramePlan& plan, MaterialFlags material_flags) {
    return (material_flags & io::kMaterialUnlit) != 0 ? plan.tone_output_flags : 0U;
}

// The variant of a pass for a group: only the flags that the pass's shader looks at. layer: of
// passes that draw several.
VariantKey
variant(const FrameContext& frame, GeometryPass pass, const DrawGroup& group, uint32_t layer = 0) {
    const auto& plan = frame.plan;
    switch (pass) {
    case GeometryPass::kDepth:
    case GeometryPass::kOverdraw:
    case GeometryPass::kInstances:
        return {hasHoles(group.material_flags) ? group.material_flags : 0U, 0, 0};
    case GeometryPass::kTransmissionDepth:
        return {(group.material_flags & io::kMaterialMask) != 0 ? group.material_flags : 0U, 0,
                layer > 0 ? io::kOutputBehindTransmissive : 0U};
    case GeometryPass::kPeelSelect:
    case GeometryPass::kPeelCount:
        return {0, 0, plan.blended_output_flags & io::kOutputBeforeTransmissive};
    case GeometryPass::kGbuffer:
    case GeometryPass::kGbufferAfterDepth:
        return {group.material_flags & ~plan.gbuffer_unused_material_flags, 0,
                plan.gbuffer_output_flags};
    case GeometryPass::kTransparent: // effects have passes of their own for solid surfaces
    case GeometryPass::kWeighted:
    case GeometryPass::kPeelShade:
        return {group.material_flags & ~plan.forward_unused_material_flags,
                plan.forward_light_flags,
                plan.blended_output_flags | toneOf(plan, group.material_flags)};
    case GeometryPass::kTransparentBehind:
        return {group.material_flags & ~plan.forward_unused_material_flags,
                plan.forward_light_flags,
                (plan.blended_output_flags & ~io::kOutputBeforeTransmissive) |
                    io::kOutputBehindTransmissive | toneOf(plan, group.material_flags)};
    case GeometryPass::kTransmission:
        return {group.material_flags & ~plan.forward_unused_material_flags,
                plan.forward_light_flags,
                plan.blended_output_flags & ~io::kOutputBeforeTransmissive};
    default:
        return {group.material_flags & ~plan.forward_unused_material_flags,
                plan.forward_light_flags, 0};
    }
}

constexpr uint32_t kStride = sizeof(vk::DrawIndexedIndirectCommand);

vk::DeviceSize commandOffset(const FrameContext& frame, uint32_t command) {
    return frame.slot.offsets.commands + vk::DeviceSize{command} * kStride;
}

// One by one, so that each tells its instance, or its triangles' places, which `peel` counts.
void drawTold(const FrameContext& frame,
              GeometryPass pass,
              const DrawGroup& group,
              vk::PipelineLayout layout,
              io::PeelDraw& peel) {
    constexpr auto kStage = vk::ShaderStageFlagBits::eFragment;
    const auto& cmd = frame.slot.cmd;
    for (uint32_t i = 0; i < group.command_count; ++i) {
        const uint32_t command = group.first_command + i;
        const vk::DrawIndexedIndirectCommand& draw = frame.draws.commands[command];
        if (peels(pass)) {
            cmd.pushConstants<io::PeelDraw>(layout, kStage, 0, peel);
            peel.first_triangle += draw.indexCount / 3;
        } else {
            cmd.pushConstants<io::InstanceDraw>(layout, kStage, 0,
                                                io::InstanceDraw{draw.firstInstance + 1});
        }
        cmd.drawIndexedIndirect(frame.slot.upload.buffer(), commandOffset(frame, command), 1,
                                kStride);
    }
}

} // namespace

void inGroups(const FrameContext& frame,
              GeometryPass pass,
              std::span<const DrawGroup> groups,
              const std::function<void(std::span<const DrawGroup>, bool first)>& record) {
    auto& pipelines = frame.scene.shared.pipelines;
    // All that are missing are asked for, before the first that is ends the recording.
    for (const DrawGroup& group : groups) {
        (void)pipelines.prepareGeometry(pass, variant(frame, pass, group));
    }
    inShares(
        frame, groups,
        [&](const DrawGroup& group) {
            return pipelines.isNewGeometry(pass, variant(frame, pass, group));
        },
        record);
}

void drawGroups(const FrameContext& frame,
                GeometryPass pass,
                std::span<const DrawGroup> groups,
                uint32_t layer) {
    const auto& cmd = frame.slot.cmd;
    auto& pipelines = frame.scene.shared.pipelines;
    const auto layout = pipelines.layoutOf(pass);
    bindGeometry(frame, layout, *frame.slot.frame_set,
                 frame.draws.indices.empty() ? *frame.scene.index_buffer.handle
                                             : frame.slot.upload.buffer(),
                 frame.slot.offsets.rows);
    vk::Pipeline bound;
    io::PeelDraw peel{.first_triangle = 0, .layer = layer};
    for (const DrawGroup& group : groups) {
        const VariantKey key = variant(frame, pass, group, layer);
        const auto pipeline = pipelines.geometry(pass, key);
        if (pipeline != bound) {
            cmd.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
            bound = pipeline;
        }
        const bool both_sides = (group.material_flags & io::kMaterialDoubleSided) != 0;
        cmd.setCullMode(both_sides ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack);
        cmd.setFrontFace(group.mirrored ? vk::FrontFace::eClockwise
                                        : vk::FrontFace::eCounterClockwise);
        if (!depthOnly(pass) || hasHoles(key.material_flags)) {
            cmd.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, layout, 1,
                                   frame.scene.materialSet(group.material), {});
        }
        if (tellsDraws(pass)) {
            drawTold(frame, pass, group, layout, peel);
        } else {
            cmd.drawIndexedIndirect(frame.slot.upload.buffer(),
                                    commandOffset(frame, group.first_command), group.command_count,
                                    kStride);
        }
    }
}

} // namespace froxel::render

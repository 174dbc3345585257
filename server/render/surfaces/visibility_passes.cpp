#include "render/surfaces/visibility_passes.h"

#include "interface/constants.h"
#include "render/frame/posed_targets.h"
#include "render/pipelines/pass_names.h"
#include "render/pipelines/screen_groups.h"
#include "render/surfaces/rendering_scope.h"
#include "render/surfaces/visibility_binding.h"

#include <array>

namespace froxel::render {

namespace {

using Point = vk::PipelineBindPoint;

// Depths from compute are replaced by those of the triangles' planes.
uint32_t depthFlag(const FrameContext& frame) {
    return frame.plan.geometry == SolidGeometry::kComputeIds ? io::kOutputDepth : 0U;
}

void shade(const FrameContext& frame,
           const vk::Rect2D& region,
           vk::DescriptorSet textures,
           const std::array<uint32_t, 2>& words) {
    frame.slot.cmd.bindDescriptorSets(Point::eCompute, frame.visibility->pipelines.computeLayout(),
                                      3, textures, {});
    pushVisibilityWords(frame, words);
    dispatchOver(frame.slot.cmd, region);
}

// A pipeline over every pixel: once with all textures, or once for each material. find() gives it.
template <class Find>
void resolve(const FrameContext& frame,
             const vk::Rect2D& region,
             const char* name,
             uint32_t last_flag,
             uint32_t flags,
             Find find) {
    const auto& scene = *frame.visibility;
    const size_t used = frame.scene.shared.variants.firstUses();
    const vk::Pipeline pipeline = find();
    if (scene.pipelines.bindless()) {
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, name);
        bindVisibilityCompute(frame, pipeline);
        shade(frame, region, scene.textureSet(), {io::kAnyMaterial, last_flag | flags});
        return;
    }
    const bool is_new = frame.scene.shared.variants.firstUses() > used;
    inShares(
        frame, scene.materials_in_use, [=](uint32_t) { return is_new; },
        [&](std::span<const uint32_t> materials, bool) {
            const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, name);
            bindVisibilityCompute(frame, pipeline);
            for (const uint32_t material : materials) {
                const bool last = material == scene.materials_in_use.back();
                shade(frame, region, frame.scene.materialSet(material),
                      {material, (last ? last_flag : 0U) | flags});
            }
        });
}

void bindGeometry(const FrameContext& frame) {
    const auto& cmd = frame.slot.cmd;
    const auto& scene = frame.scene;
    const VertexBuffers vertices = vertexBuffers(scene, frame.slot);
    const std::array buffers = {vertices.positions, vertices.surfaces,
                                vertices.extended ? vertices.extended : vertices.surfaces};
    const std::array<vk::DeviceSize, 3> offsets = {0, 0, 0};
    cmd.bindVertexBuffers(0, buffers, offsets);
    cmd.bindIndexBuffer(*scene.index_buffer.handle, 0, vk::IndexType::eUint32);
    const auto layout = frame.visibility->pipelines.rasterLayout();
    cmd.bindDescriptorSets(Point::eGraphics, layout, 0, *frame.slot.frame_set, {});
    cmd.bindDescriptorSets(Point::eGraphics, layout, 2,
                           frame.slot.stored.get<VisibilityFrame>().set(), {});
}

void drawGroup(const FrameContext& frame, uint32_t index) {
    const auto& cmd = frame.slot.cmd;
    auto& scene = *frame.visibility;
    const VisibilityGroup& group = scene.groups[index];
    cmd.bindPipeline(Point::eGraphics, scene.pipelines.raster(group.material_flags));
    const bool both_sides = (group.material_flags & io::kMaterialDoubleSided) != 0;
    cmd.setCullMode(both_sides ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack);
    cmd.setFrontFace(group.mirrored ? vk::FrontFace::eClockwise : vk::FrontFace::eCounterClockwise);
    if ((group.material_flags & io::kMaterialMask) != 0) {
        cmd.bindDescriptorSets(Point::eGraphics, scene.pipelines.rasterLayout(), 1,
                               frame.scene.materialSet(group.material), {});
    }
    const CulledDraws& draws = scene.culledDraws();
    constexpr uint32_t kStride = sizeof(io::DrawCommand);
    const vk::DeviceSize first =
        vk::DeviceSize{group.blocks.first_block} * io::kCullGroup * kStride;
    if (frame.scene.shared.device.traits().draw_indirect_count) {
        cmd.drawIndexedIndirectCount(*draws.commands.handle, first, *draws.counts.handle,
                                     index * sizeof(uint32_t), group.meshlet_count, kStride);
    } else {
        cmd.drawIndexedIndirect(*draws.commands.handle, first, group.meshlet_count, kStride);
    }
}

} // namespace

void recordEmptyDraws(const FrameContext& frame) {
    frame.slot.cmd.fillBuffer(*frame.visibility->culledDraws().commands.handle, 0, VK_WHOLE_SIZE,
                              0);
}

void recordCull(const FrameContext& frame, bool culls) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kCull);
    const auto& scene = *frame.visibility;
    dispatchCull(frame, scene.pipelines.cull(scene.hasLevels()), culls);
}

void recordCompact(const FrameContext& frame) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kCompact);
    dispatchCull(frame, frame.visibility->pipelines.compact(), true);
}

void recordVisibility(const FrameContext& frame, const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kVisibility);
    // Ids of empty pixels are never read: their depth says so.
    const std::array colors = {
        attachment(frame.slot.targets->ids, vk::AttachmentLoadOp::eDontCare)};
    const auto depth =
        attachment(frame.slot.targets->depth, vk::AttachmentLoadOp::eClear, farDepth());
    const Rendering rendering(frame, region, colors, &depth);
    bindGeometry(frame);
    for (uint32_t i = 0; i < frame.visibility->groups.size(); ++i) {
        drawGroup(frame, i);
    }
}

void recordVisibilityGbuffer(const FrameContext& frame, const vk::Rect2D& region) {
    resolve(frame, region, pass::kResolve, io::kResolveLast, 0, [&] {
        return frame.visibility->pipelines.gbuffer(
            {frame.visibility->material_flags, 0,
             frame.plan.gbuffer_output_flags | depthFlag(frame)});
    });
}

void recordVisibilityShade(const FrameContext& frame,
                           const vk::Rect2D& region,
                           uint32_t output_flags) {
    const uint32_t reused = reusesSurfaces(frame.plan) ? io::kResolveReused : 0U;
    resolve(frame, region, pass::kShade, io::kResolveLast, reused, [&] {
        return frame.visibility->pipelines.shade(
            {frame.visibility->material_flags & ~frame.plan.forward_unused_material_flags,
             frame.plan.lighting_light_flags, output_flags | depthFlag(frame)});
    });
}

void recordVisibilityLayers(const FrameContext& frame, const vk::Rect2D& region) {
    // Depths are those of planes since the G-buffer was filled.
    resolve(frame, region, pass::kLayers, 0, io::kResolveLayers | io::kResolveReused, [&] {
        return frame.visibility->pipelines.shade({frame.visibility->material_flags,
                                                  frame.plan.lighting_light_flags,
                                                  io::kOutputRadiance});
    });
}

} // namespace froxel::render

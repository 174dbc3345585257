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

// What a pass makes of ids.
struct Resolving {
    const char* name = "";
    uint32_t flags = 0;
    uint32_t last_flag = 0;        // of its last dispatch, too
    vk::DescriptorSet behind = {}; // null: it sees nothing through surfaces
    vk::Buffer tiles = {};         // of its layer alone; null: all of the region
    uint32_t layer = 0;
};

void dispatchResolve(const FrameContext& frame,
                     const vk::Rect2D& region,
                     const Resolving& as,
                     vk::DescriptorSet textures,
                     const std::array<uint32_t, 2>& words) {
    const auto& cmd = frame.slot.cmd;
    const auto& pipelines = frame.visibility->pipelines;
    if (as.behind) {
        const std::array sets = {textures, as.behind};
        cmd.bindDescriptorSets(Point::eCompute, pipelines.transmissionLayout(), 3, sets, {});
    } else {
        cmd.bindDescriptorSets(Point::eCompute, pipelines.computeLayout(), 3, textures, {});
    }
    pushVisibilityWords(frame, words);
    if (as.tiles) {
        dispatchTiles(frame, as.tiles, as.layer);
    } else {
        dispatchOver(cmd, region);
    }
}

// A pipeline over every pixel: once with all textures, or once for each material. find() gives it.
template <class Find>
void resolve(const FrameContext& frame, const vk::Rect2D& region, const Resolving& as, Find find) {
    const auto& scene = *frame.visibility;
    const size_t used = frame.scene.shared.variants.firstUses();
    const vk::Pipeline pipeline = find();
    if (scene.pipelines.bindless()) {
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, as.name);
        bindVisibilityCompute(frame, pipeline);
        dispatchResolve(frame, region, as, scene.textureSet(),
                        {io::kAnyMaterial, as.last_flag | as.flags});
        return;
    }
    const bool is_new = frame.scene.shared.variants.firstUses() > used;
    inShares(
        frame, scene.materials_in_use, [=](uint32_t) { return is_new; },
        [&](std::span<const uint32_t> materials, bool) {
            const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, as.name);
            bindVisibilityCompute(frame, pipeline);
            for (const uint32_t material : materials) {
                const bool last = material == scene.materials_in_use.back();
                dispatchResolve(frame, region, as, frame.scene.materialSet(material),
                                {material, (last ? as.last_flag : 0U) | as.flags});
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
    cmd.bindDescriptorSets(Point::eGraphics, layout, 2, visibilitySet(frame), {});
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
    resolve(frame, region, {.name = pass::kResolve, .last_flag = io::kResolveLast}, [&] {
        return frame.visibility->pipelines.gbuffer(
            {frame.visibility->material_flags, 0,
             frame.plan.gbuffer_output_flags | depthFlag(frame)});
    });
}

void recordVisibilityShade(const FrameContext& frame,
                           const vk::Rect2D& region,
                           uint32_t output_flags) {
    const uint32_t reused = reusesSurfaces(frame.plan) ? io::kResolveReused : 0U;
    resolve(frame, region, {pass::kShade, reused, io::kResolveLast}, [&] {
        return frame.visibility->pipelines.shade(
            {frame.visibility->material_flags & ~frame.plan.forward_unused_material_flags,
             frame.plan.lighting_light_flags, output_flags | depthFlag(frame)});
    });
}

void recordVisibilityTransmission(const FrameContext& frame,
                                  const vk::Rect2D& region,
                                  vk::DescriptorSet behind,
                                  uint32_t layer,
                                  vk::Buffer tiles) {
    const uint32_t which = layer << io::kResolveLayerShift | (tiles ? io::kResolveTiles : 0U);
    const Resolving as{.name = pass::kTransmission,
                       .flags = which,
                       .behind = behind,
                       .tiles = tiles,
                       .layer = layer};
    resolve(frame, region, as, [&] {
        const auto& plan = frame.plan;
        return frame.visibility->pipelines.shadeTransmission(
            {frame.visibility->material_flags & ~plan.forward_unused_material_flags,
             plan.lighting_light_flags,
             plan.blended_output_flags & ~io::kOutputBeforeTransmissive});
    });
}

void recordVisibilityLayers(const FrameContext& frame, const vk::Rect2D& region) {
    // Depths are those of planes since the G-buffer was filled.
    resolve(frame, region, {pass::kLayers, io::kResolveLayers | io::kResolveReused}, [&] {
        return frame.visibility->pipelines.shade({frame.visibility->material_flags,
                                                  frame.plan.lighting_light_flags,
                                                  io::kOutputRadiance});
    });
}

} // namespace froxel::render

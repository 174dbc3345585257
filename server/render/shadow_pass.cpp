#include "render/shadow_pass.h"

#include "gpu/pipeline.h"
#include "interface/constants.h"
#include "interface/shadow_io.h"
#include "render/frame_recorder.h"
#include "render/geometry_draws.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace froxel::render {

namespace {

using Type = vk::DescriptorType;

uint32_t tilesFor(const view::Shadows& settings, uint32_t light_count) {
    return 6 * std::clamp(light_count, 1U, settings.light_count);
}

vk::Extent2D extentOf(uint32_t tile_count, uint32_t size_px) {
    const uint32_t rows = (tile_count + io::kShadowColumns - 1) / io::kShadowColumns;
    return {std::min(tile_count, io::kShadowColumns) * size_px, rows * size_px};
}

vk::raii::DescriptorPool makePool(const gpu::Device& device) {
    std::vector<vk::DescriptorPoolSize> sizes;
    for (const Type type : Pipelines::kFrameBindingTypes) {
        sizes.push_back({type, 1});
    }
    return gpu::makeDescriptorPool(device, sizes);
}

void drawFace(const FrameContext& frame, const ShadowFace& face) {
    const auto& cmd = frame.slot.cmd;
    auto& pipelines = frame.scene.pipelines;
    const uint32_t size = frame.slot.shadows->size_px;
    const vk::Offset2D corner(static_cast<int32_t>(face.tile % io::kShadowColumns * size),
                              static_cast<int32_t>(face.tile / io::kShadowColumns * size));
    cmd.setViewport(0, vk::Viewport{static_cast<float>(corner.x), static_cast<float>(corner.y),
                                    static_cast<float>(size), static_cast<float>(size), 0, 1});
    cmd.setScissor(0, vk::Rect2D{corner, {size, size}});
    for (uint32_t i = face.first_group; i < face.first_group + face.group_count; ++i) {
        const ShadowGroup& group = frame.shadows->groups[i];
        cmd.bindPipeline(vk::PipelineBindPoint::eGraphics,
                         pipelines.geometry(GeometryPass::kDepth, {group.material_flags, 0, 0}));
        if (group.material_flags != 0) {
            cmd.bindDescriptorSets(vk::PipelineBindPoint::eGraphics,
                                   pipelines.geometryPipelineLayout(), 1,
                                   frame.scene.materialSet(group.material), {});
        }
        constexpr uint32_t kStride = sizeof(vk::DrawIndexedIndirectCommand);
        cmd.drawIndexedIndirect(frame.slot.upload.buffer(),
                                frame.offsets.shadow_commands +
                                    vk::DeviceSize{group.first_command} * kStride,
                                group.command_count, kStride);
    }
}

} // namespace

gpu::ImageInfo shadowImage(const view::Shadows& settings, uint32_t light_count) {
    using Usage = vk::ImageUsageFlagBits;
    return {.format = Pipelines::kDepthFormat,
            .extent = extentOf(tilesFor(settings, light_count), settings.size_px),
            .usage = Usage::eDepthStencilAttachment | Usage::eSampled | Usage::eTransferSrc,
            .aspect = vk::ImageAspectFlagBits::eDepth};
}

ShadowTargets::ShadowTargets(const gpu::Device& device,
                             const view::Shadows& settings,
                             uint32_t light_count)
    : size_px(settings.size_px), tile_count(tilesFor(settings, light_count)), arena(device) {
    atlas = arena.makeImage(shadowImage(settings, light_count), "shadow atlas");
}

bool ShadowTargets::fits(const view::Shadows& settings, uint32_t light_count) const {
    return size_px == settings.size_px && tile_count == tilesFor(settings, light_count);
}

std::shared_ptr<ShadowTargets> shadowTargetsFor(const gpu::Device& device,
                                                const view::Shadows& settings,
                                                uint32_t light_count,
                                                bool drawn,
                                                std::shared_ptr<ShadowTargets> last) {
    if (last && (settings.light_count == 0 || !last->fits(settings, light_count))) {
        last.reset();
    }
    return drawn && !last ? std::make_shared<ShadowTargets>(device, settings, light_count) : last;
}

vk::DescriptorImageInfo atlasInfo(const ShadowTargets* targets) {
    return {.imageView = targets != nullptr ? *targets->atlas.view : vk::ImageView(),
            .imageLayout = vk::ImageLayout::eGeneral};
}

ShadowSlot::ShadowSlot(const gpu::Device& device, const Pipelines& pipelines)
    : device_(device), pool_(makePool(device)) {
    set_ = gpu::makeSet(device, pool_, pipelines.frameLayout());
}

void ShadowSlot::write(vk::Buffer upload, vk::DeviceSize uniforms) {
    // All but the uniforms is described as none: lavapipe binds whole sets.
    const vk::DescriptorBufferInfo frame{upload, uniforms, sizeof(io::Frame)};
    const vk::DescriptorBufferInfo no_buffer{.buffer = {}, .range = VK_WHOLE_SIZE};
    const vk::DescriptorImageInfo no_image = atlasInfo(nullptr);
    const vk::BufferView no_view;
    std::array<vk::WriteDescriptorSet, Pipelines::kFrameBindings> writes;
    for (uint32_t i = 0; i < writes.size(); ++i) {
        writes[i] = {.dstSet = *set_,
                     .dstBinding = i,
                     .descriptorCount = 1,
                     .descriptorType = Pipelines::kFrameBindingTypes[i],
                     .pImageInfo = &no_image,
                     .pBufferInfo = i == 0 ? &frame : &no_buffer,
                     .pTexelBufferView = &no_view};
    }
    device_.handle().updateDescriptorSets(writes, {});
}

ShadowAtlas
copyShadows(SceneResources& scene, const ShadowTargets& targets, const ShadowFrame& frame) {
    const auto& extent = targets.atlas.extent;
    ShadowAtlas atlas{targets.size_px, extent.width, {}, frame.shadow_of_light, {}};
    for (const auto& light : frame.lights) {
        atlas.first_tiles.push_back(static_cast<uint32_t>(light.first_tile));
    }
    atlas.depths.resize(size_t{extent.width} * extent.height);
    const vk::DeviceSize bytes = atlas.depths.size() * sizeof(float);
    const Readback readback(scene.device, bytes);
    scene.timeline.runNow([&](const vk::raii::CommandBuffer& cmd) {
        recordTargetCopy(cmd, targets.atlas, vk::ImageAspectFlagBits::eDepth, readback.buffer);
    });
    std::memcpy(atlas.depths.data(), readback.buffer.mapped, bytes);
    return atlas;
}

namespace {

// The first of them clear the atlas.
void recordFaces(const FrameContext& frame, std::span<const ShadowFace> faces, bool first) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, "shadows");
    const auto& cmd = frame.slot.cmd;
    const auto& targets = *frame.slot.shadows;
    const vk::RenderingAttachmentInfo depth{
        .imageView = *targets.atlas.view,
        .imageLayout = vk::ImageLayout::eGeneral,
        .loadOp = first ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eLoad,
        .storeOp = vk::AttachmentStoreOp::eStore,
        .clearValue = vk::ClearDepthStencilValue{.depth = 0.0F, .stencil = 0}}; // nothing so far
    const auto used = static_cast<uint32_t>(frame.shadows->faces.size());
    cmd.beginRendering({.renderArea = {{0, 0}, extentOf(used, targets.size_px)},
                        .layerCount = 1,
                        .pDepthAttachment = &depth});
    bindGeometry(frame, frame.scene.pipelines.geometryPipelineLayout(),
                 frame.slot.shadow_slot->set(), *frame.scene.index_buffer.handle,
                 frame.offsets.shadow_rows);
    cmd.setCullMode(vk::CullModeFlagBits::eNone);
    cmd.setFrontFace(vk::FrontFace::eCounterClockwise);
    for (const ShadowFace& face : faces) {
        drawFace(frame, face);
    }
    cmd.endRendering();
}

} // namespace

void recordShadows(const FrameContext& frame) {
    const std::span<const ShadowFace> faces = frame.shadows->faces;
    const size_t at_once = frame.pieces.fits(frame.costs.shadowFace());
    for (size_t first = 0; first < faces.size(); first += at_once) {
        const auto part = faces.subspan(first, std::min(at_once, faces.size() - first));
        frame.pieces.add(static_cast<double>(part.size()) * frame.costs.shadowFace());
        recordFaces(frame, part, first == 0);
    }
}

} // namespace froxel::render

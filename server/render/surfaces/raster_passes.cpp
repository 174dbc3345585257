#include "render/surfaces/raster_passes.h"

#include "render/pipelines/pass_names.h"
#include "render/pipelines/screen_groups.h"
#include "render/scene/compute_raster.h"
#include "render/surfaces/visibility_binding.h"

#include <array>
#include <cstddef>

namespace froxel::render {

namespace {

using Point = vk::PipelineBindPoint;

const ComputeRaster& raster(const FrameContext& frame) {
    return frame.visibility->computeRaster();
}

using RasterStep = VisibilityPipelines::ComputeStep;

bool keepsLayers(const FrameContext& frame) {
    return frame.visibility->surfaces == Surfaces::kTransmissive;
}

const char* passName(const FrameContext& frame, const char* of_solid) {
    return keepsLayers(frame) ? pass::kTransmissionDepth : of_solid;
}

RasterStep stepOfMeshlets(const FrameContext& frame) {
    return keepsLayers(frame)            ? RasterStep::kPeeledMeshlets
           : raster(frame).many_meshlets ? RasterStep::kManyMeshlets
                                         : RasterStep::kMeshlets;
}

// What is opaque; then what is masked, with all textures or one material's at a time.
template <class Dispatch>
void drawMaterials(const FrameContext& frame, RasterStep step, uint32_t batch, Dispatch dispatch) {
    const auto& scene = *frame.visibility;
    const auto draw = [&](vk::DescriptorSet textures, uint32_t material) {
        frame.slot.cmd.bindDescriptorSets(Point::eCompute, scene.pipelines.computeLayout(), 3,
                                          textures, {});
        pushVisibilityWords(frame, {material, batch});
        dispatch();
    };
    const bool all_textures = scene.pipelines.bindless();
    if (raster(frame).opaque) { // reads none
        bindVisibilityCompute(frame, scene.pipelines.compute(step));
        draw(all_textures ? scene.textureSet()
                          : frame.scene.materialSet(scene.materials_in_use.front()),
             io::kAnyMaterial);
    }
    if (raster(frame).masked_flags == 0) {
        return;
    }
    bindVisibilityCompute(frame, scene.pipelines.compute(step, raster(frame).masked_flags));
    if (all_textures) {
        draw(scene.textureSet(), io::kAnyMaterial);
    }
    for (const uint32_t material : raster(frame).masked_materials) {
        draw(frame.scene.materialSet(material), material);
    }
}

// One of its counts of workgroups.
void dispatchOf(const FrameContext& frame, uint32_t batch, size_t offset_of_count) {
    frame.slot.cmd.dispatchIndirect(*raster(frame).batches.handle,
                                    batch * sizeof(io::RasterBatch) + offset_of_count);
}

// None where the batch is empty.
void dispatchOthers(const FrameContext& frame, uint32_t batch) {
    dispatchOf(frame, batch, offsetof(io::RasterBatch, others));
}

vk::BufferImageCopy wholeImage(const FrameContext& frame, vk::ImageAspectFlags aspect) {
    const auto& size = frame.drawn();
    return {.imageSubresource = {aspect, 0, 0, 1},
            .imageExtent = {size.width_px, size.height_px, 1}};
}

} // namespace

void recordRasterClear(const FrameContext& frame) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kRasterClear);
    frame.slot.cmd.fillBuffer(*frame.slot.targets->words.handle, 0, VK_WHOLE_SIZE, 0);
    frame.slot.cmd.updateBuffer<io::RasterBatch>(*raster(frame).batches.handle, 0,
                                                 raster(frame).empty_batches);
}

void recordRasterSpoil(const FrameContext& frame) {
    if (const auto& words = frame.slot.targets->words; *words.handle) {
        frame.slot.cmd.fillBuffer(*words.handle, 0, VK_WHOLE_SIZE, 0xa5a5a5a5);
    }
}

void recordRasterCull(const FrameContext& frame, bool culls) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, passName(frame, pass::kCull));
    const auto& scene = *frame.visibility;
    const auto step = scene.hasLevels() ? RasterStep::kCullListDetail : RasterStep::kCullList;
    dispatchCull(frame, scene.pipelines.compute(step), culls);
}

uint32_t rasterBatchCount(const FrameContext& frame) {
    return static_cast<uint32_t>(raster(frame).empty_batches.size());
}

void recordRasterMeshlets(const FrameContext& frame, uint32_t batch) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd,
                               passName(frame, pass::kRasterMeshlets));
    const size_t drawn =
        batch > 0 ? offsetof(io::RasterBatch, drawn) : offsetof(io::RasterBatch, listed);
    drawMaterials(frame, stepOfMeshlets(frame), batch, [&] { dispatchOf(frame, batch, drawn); });
}

void recordRasterBlocks(const FrameContext& frame, uint32_t batch) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd,
                               passName(frame, pass::kRasterBlocks));
    const auto step = keepsLayers(frame) ? RasterStep::kPeeledBlocks : RasterStep::kBlocks;
    drawMaterials(frame, step, batch, [&] { dispatchOthers(frame, batch); });
}

void recordRasterFar(const FrameContext& frame, uint32_t batch) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kRasterFar);
    bindVisibilityCompute(frame, frame.visibility->pipelines.compute(RasterStep::kFar));
    dispatchOthers(frame, batch);
}

void recordRasterHidden(const FrameContext& frame, uint32_t batch) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kRasterHidden);
    bindVisibilityCompute(frame, frame.visibility->pipelines.compute(RasterStep::kHidden));
    pushVisibilityWords(frame, {io::kAnyMaterial, batch});
    dispatchOthers(frame, batch);
}

void recordRasterUnpack(const FrameContext& frame) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kRasterUnpack);
    bindVisibilityCompute(frame, frame.visibility->pipelines.compute(RasterStep::kUnpack));
    dispatchOver(frame.slot.cmd, {{}, {frame.drawn().width_px, frame.drawn().height_px}});
}

void recordLayerTiles(const FrameContext& frame, const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kTransmissionDepth);
    bindVisibilityCompute(frame, frame.visibility->pipelines.compute(RasterStep::kLayerTiles));
    dispatchOver(frame.slot.cmd, region);
}

void recordLayerTilesAndDepth(const FrameContext& frame, const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kTransmissionDepth);
    bindVisibilityCompute(frame, frame.visibility->pipelines.compute(RasterStep::kLayerTilesDepth));
    const auto first = static_cast<uint32_t>(region.offset.y);
    pushVisibilityWords(frame, {first, first + region.extent.height});
    dispatchOver(frame.slot.cmd, {{}, {frame.drawn().width_px, frame.drawn().height_px}});
}

void recordDepthOut(const FrameContext& frame) {
    const auto& targets = *frame.slot.targets;
    frame.slot.cmd.copyImageToBuffer(*targets.compute_depth.handle, vk::ImageLayout::eGeneral,
                                     *targets.words.handle,
                                     wholeImage(frame, vk::ImageAspectFlagBits::eColor));
}

void recordDepthIn(const FrameContext& frame) {
    const auto& targets = *frame.slot.targets;
    frame.slot.cmd.copyBufferToImage(*targets.words.handle, *targets.depth.handle,
                                     vk::ImageLayout::eGeneral,
                                     wholeImage(frame, vk::ImageAspectFlagBits::eDepth));
}

} // namespace froxel::render

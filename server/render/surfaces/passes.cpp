#include "render/surfaces/passes.h"

#include "interface/constants.h"
#include "render/frame/pass_names.h"
#include "render/pipelines/screen_groups.h"
#include "render/surfaces/geometry_draws.h"
#include "render/surfaces/rendering_scope.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

namespace froxel::render {

namespace {

using LoadOp = vk::AttachmentLoadOp;

// Counts the samples that pass the depth test, in the pass that draws depth first.
class SampleScope {
  public:
    SampleScope(const FrameContext& frame, bool first)
        : counter_(first && frame.plan.count_samples ? frame.slot.samples.get() : nullptr),
          cmd_(frame.slot.cmd) {
        if (counter_ != nullptr) {
            counter_->begin(cmd_);
        }
    }
    ~SampleScope() {
        if (counter_ != nullptr) {
            counter_->end(cmd_);
        }
    }
    SampleScope(const SampleScope&) = delete;
    SampleScope& operator=(const SampleScope&) = delete;

  private:
    gpu::SampleCounter* counter_;
    const vk::raii::CommandBuffer& cmd_;
};

// Nothing, which covers nothing of the background.
vk::ClearValue nothing() {
    return vk::ClearColorValue(std::array{0.0F, 0.0F, 0.0F, 0.0F});
}

void bindScreen(const FrameContext& frame, vk::PipelineBindPoint point, vk::Pipeline pipeline) {
    const auto& cmd = frame.slot.cmd;
    cmd.bindPipeline(point, pipeline);
    const std::array sets = {*frame.slot.frame_set, *frame.slot.screen_set};
    cmd.bindDescriptorSets(point, frame.scene.shared.pipelines.screenPipelineLayout(), 0, sets, {});
}

void dispatch(const FrameContext& frame,
              ScreenPass pass,
              const VariantKey& key,
              const vk::Rect2D& region) {
    bindScreen(frame, vk::PipelineBindPoint::eCompute,
               frame.scene.shared.pipelines.screen(pass, key));
    dispatchOver(frame.slot.cmd, region);
}

// Calls record(sets) in a rendering of lines over radiance.
template <class Record>
void inWires(const FrameContext& frame, Record record) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kWires);
    const std::array colors = {attachment(frame.slot.targets->radiance, LoadOp::eLoad)};
    const auto& size = frame.slot.targets->size;
    const Rendering rendering(frame, {{0, 0}, {size.width_px, size.height_px}}, colors, nullptr);
    frame.slot.cmd.setCullMode(vk::CullModeFlagBits::eNone);
    frame.slot.cmd.setFrontFace(vk::FrontFace::eCounterClockwise);
    record(DebugSets{*frame.slot.frame_set, *frame.slot.screen_set});
}

} // namespace

void recordPoseVertices(const FrameContext& frame) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kPose);
    frame.scene.poser()->recordVertices(frame.slot.cmd, frame.slot.pose->set());
}

void recordPoseFlatNormals(const FrameContext& frame) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kPose);
    frame.scene.poser()->recordFlatNormals(frame.slot.cmd, frame.slot.pose->set());
}

void recordDepthPrepass(const FrameContext& frame, const vk::Rect2D& region) {
    inGroups(frame, GeometryPass::kDepth, frame.draws.solid, [&](const auto& groups, bool first) {
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kDepthPrepass);
        const SampleScope samples(frame, true);
        const auto depth = attachment(frame.slot.targets->depth,
                                      first ? LoadOp::eClear : LoadOp::eLoad, farDepth());
        const Rendering rendering(frame, region, {}, &depth);
        drawGroups(frame, GeometryPass::kDepth, groups);
    });
}

void recordForwardPass(const FrameContext& frame, const vk::Rect2D& region) {
    const bool after_depth = frame.plan.depth_prepass;
    const auto pass = after_depth ? GeometryPass::kForwardAfterDepth : GeometryPass::kForward;
    inGroups(frame, pass, frame.draws.solid, [&](const auto& groups, bool first) {
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kForward);
        const SampleScope samples(frame, !after_depth);
        const std::array colors = {attachment(frame.slot.targets->radiance,
                                              first ? LoadOp::eClear : LoadOp::eLoad, nothing())};
        const auto depth =
            attachment(frame.slot.targets->depth,
                       first && !after_depth ? LoadOp::eClear : LoadOp::eLoad, farDepth());
        const Rendering rendering(frame, region, colors, &depth);
        drawGroups(frame, pass, groups);
    });
}

void recordGbuffer(const FrameContext& frame, const vk::Rect2D& region) {
    const bool after_depth = frame.plan.depth_prepass;
    const auto pass = after_depth ? GeometryPass::kGbufferAfterDepth : GeometryPass::kGbuffer;
    inGroups(frame, pass, frame.draws.solid, [&](const auto& groups, bool first) {
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kGbuffer);
        const SampleScope samples(frame, !after_depth);
        // Words of empty pixels are never read: their depth says so.
        std::vector colors = {
            attachment(frame.slot.targets->gbuffer, first ? LoadOp::eDontCare : LoadOp::eLoad)};
        if (*frame.slot.targets->gbuffer_extra.handle) {
            // A stored depth of 0 is an empty pixel.
            colors.push_back(attachment(frame.slot.targets->gbuffer_extra,
                                        first ? LoadOp::eClear : LoadOp::eLoad,
                                        vk::ClearColorValue(std::array<uint32_t, 4>{})));
        }
        const auto depth =
            attachment(frame.slot.targets->depth,
                       first && !after_depth ? LoadOp::eClear : LoadOp::eLoad, farDepth());
        const Rendering rendering(frame, region, colors, &depth);
        drawGroups(frame, pass, groups);
    });
}

void recordLightingCompute(const FrameContext& frame, const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kLighting);
    dispatch(frame, ScreenPass::kLighting,
             {0, frame.plan.lighting_light_flags, frame.plan.lighting_output_flags}, region);
}

void recordLightingFragment(const FrameContext& frame, const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kLighting);
    // Where compute rasters, the depth buffer is another image.
    const bool covered_alone = !frame.plan.compute_raster;
    const std::array colors = {attachment(frame.slot.targets->radiance,
                                          covered_alone ? LoadOp::eClear : LoadOp::eDontCare,
                                          nothing())};
    auto depth = attachment(frame.slot.targets->depth, LoadOp::eLoad);
    depth.storeOp = vk::AttachmentStoreOp::eNone; // the shader loads it, too
    const Rendering rendering(frame, region, colors, covered_alone ? &depth : nullptr);
    bindScreen(
        frame, vk::PipelineBindPoint::eGraphics,
        frame.scene.shared.pipelines.fragmentLighting(
            {0, frame.plan.lighting_light_flags, frame.plan.lighting_output_flags}, covered_alone));
    frame.slot.cmd.setCullMode(vk::CullModeFlagBits::eNone);
    frame.slot.cmd.setFrontFace(vk::FrontFace::eCounterClockwise);
    frame.slot.cmd.draw(3, 1, 0, 0);
}

// Of surfaces at the same depth one with layers stays, whichever was drawn last.
void recordLayers(const FrameContext& frame, const vk::Rect2D& region) {
    std::vector<DrawGroup> layered;
    std::ranges::copy_if(frame.draws.solid, std::back_inserter(layered), [](const DrawGroup& it) {
        return (it.material_flags & io::kMaterialLayers) != 0;
    });
    const auto pass = GeometryPass::kForwardAfterDepth;
    inGroups(frame, pass, layered, [&](const auto& groups, bool) {
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kLayers);
        const std::array colors = {attachment(frame.slot.targets->radiance, LoadOp::eLoad)};
        const auto depth = attachment(frame.slot.targets->depth, LoadOp::eLoad);
        const Rendering rendering(frame, region, colors, &depth);
        drawGroups(frame, pass, groups);
    });
}

void recordToon(const FrameContext& frame, const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kToon);
    dispatch(frame, ScreenPass::kToon,
             {0, frame.plan.toon_bands ? io::kLightBands : 0U, frame.plan.toon_output_flags},
             region);
}

void recordOutline(const FrameContext& frame, const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kOutline);
    dispatch(frame, ScreenPass::kOutline, {0, 0, frame.plan.gbuffer_output_flags}, region);
}

void recordTransparent(const FrameContext& frame, const vk::Rect2D& region) {
    const auto pass = GeometryPass::kTransparent;
    inGroups(frame, pass, frame.draws.transparent, [&](const auto& groups, bool first) {
        const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kTransparent);
        const auto& sums =
            frame.plan.over_unlit ? frame.slot.blend->sums : frame.slot.targets->radiance;
        const auto load = frame.plan.over_unlit && first ? LoadOp::eClear : LoadOp::eLoad;
        const std::array colors = {attachment(sums, load, nothing())};
        const auto depth = attachment(frame.slot.targets->depth, LoadOp::eLoad);
        const Rendering rendering(frame, region, colors, &depth);
        drawGroups(frame, pass, groups);
    });
}

void recordTonemap(const FrameContext& frame, const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kTonemap);
    dispatch(frame, ScreenPass::kTonemap, {0, 0, frame.plan.tonemap_output_flags}, region);
}

void recordOverdraw(const FrameContext& frame, const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kOverdraw);
    const vk::ClearValue none = vk::ClearColorValue(std::array{0.0F, 0.0F, 0.0F, 0.0F});
    const std::array colors = {attachment(frame.slot.targets->radiance, LoadOp::eClear, none)};
    const auto depth = attachment(frame.slot.targets->depth, LoadOp::eClear, farDepth());
    const Rendering rendering(frame, region, colors, &depth);
    drawGroups(frame, GeometryPass::kOverdraw, frame.draws.solid);
}

void recordDebugView(const FrameContext& frame, const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kDebugView);
    frame.scene.shared.debug().recordValues(
        frame.slot.cmd, {*frame.slot.frame_set, *frame.slot.screen_set}, frame.plan.debug,
        frame.plan.lighting_light_flags, frame.plan.gbuffer_output_flags, frame.debug->values,
        region);
}

void recordLightWires(const FrameContext& frame, uint32_t first_light, uint32_t light_count) {
    inWires(frame, [&](const DebugSets& sets) {
        frame.scene.shared.debug().recordLights(frame.slot.cmd, sets, first_light, light_count);
    });
}

void recordClusterWires(const FrameContext& frame, uint32_t first_line, uint32_t line_count) {
    inWires(frame, [&](const DebugSets& sets) {
        frame.scene.shared.debug().recordClusters(frame.slot.cmd, sets, frame.slot.upload.buffer(),
                                                  frame.offsets.wires, 2 * first_line,
                                                  2 * line_count);
    });
}

void recordCountPairs(const FrameContext& frame, const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kCountPairs);
    frame.slot.pairs->recordCount(
        frame.slot.cmd, frame.scene.shared.pairs(), *frame.slot.frame_set, *frame.slot.screen_set,
        frame.plan.forward ? frame.plan.forward_light_flags : frame.plan.lighting_light_flags,
        region);
}

void recordReadback(const FrameContext& frame) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kReadback);
    const auto& pixels = frame.slot.targets->pixels;
    frame.slot.cmd.copyBuffer(*pixels.handle, *frame.slot.readback->buffer.handle,
                              vk::BufferCopy{.size = pixels.size_bytes});
}

void recordRadianceReadback(const FrameContext& frame, const vk::Rect2D& region) {
    const gpu::PassScope scope(frame.slot.timestamps, frame.slot.cmd, pass::kRadianceReadback);
    const uint32_t row_px = frame.slot.targets->size.width_px;
    const auto x = static_cast<vk::DeviceSize>(region.offset.x);
    const auto y = static_cast<vk::DeviceSize>(region.offset.y);
    frame.slot.cmd.copyImageToBuffer(
        *frame.slot.targets->radiance.handle, vk::ImageLayout::eGeneral,
        *frame.slot.readback->radiance.handle,
        vk::BufferImageCopy{.bufferOffset = (y * row_px + x) * 4 * sizeof(float),
                            .bufferRowLength = row_px,
                            .imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                            .imageOffset = {region.offset.x, region.offset.y, 0},
                            .imageExtent = {region.extent.width, region.extent.height, 1}});
}

} // namespace froxel::render

#include "render/debug_pass.h"

#include "embedded.h"
#include "gpu/pipeline.h"
#include "render/pair_counter.h"
#include "render/screen_groups.h"

#include <algorithm>

namespace froxel::render {

namespace {

gpu::GraphicsPipelineInfo wiresInfo(gpu::Spirv vertex, vk::PipelineLayout layout) {
    gpu::GraphicsPipelineInfo info;
    info.vertex = vertex;
    info.fragment = shaders::wire_frag();
    info.constants = {0, 0, 0, 1};
    info.layout = layout;
    info.color_formats = {Pipelines::kRadianceFormat};
    info.blend = gpu::Blend::kOver;
    info.lines = true;
    return info;
}

} // namespace

DebugPass::DebugPass(const gpu::Device& device, const Pipelines& shared)
    : device_(device),
      values_layout_(gpu::makePipelineLayout(
          device, {shared.frameLayout(), shared.screenLayout()}, sizeof(io::DebugFrame))),
      wires_layout_(shared.screenPipelineLayout()) {}

void DebugPass::recordValues(const vk::raii::CommandBuffer& cmd,
                             const DebugSets& sets,
                             const VariantKey& key,
                             const io::DebugFrame& values,
                             const vk::Rect2D& region) {
    const VariantKey used{0, key.light_flags & kListFlags, key.output_flags};
    if (values_key_ != used) {
        // The slot's last frame has finished: nothing uses the old one.
        values_ = gpu::makeComputePipeline(device_, shaders::debug_view_comp(),
                                           {0, used.light_flags, used.output_flags, 1},
                                           *values_layout_, "debug view");
        values_key_ = used;
    }
    cmd.bindPipeline(vk::PipelineBindPoint::eCompute, *values_);
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *values_layout_, 0, sets, {});
    cmd.pushConstants<io::DebugFrame>(*values_layout_, vk::ShaderStageFlagBits::eCompute, 0,
                                      values);
    dispatchOver(cmd, region);
}

void DebugPass::bindWires(const vk::raii::CommandBuffer& cmd,
                          const DebugSets& sets,
                          const vk::raii::Pipeline& pipeline) const {
    cmd.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, wires_layout_, 0, sets, {});
}

void DebugPass::recordLights(const vk::raii::CommandBuffer& cmd,
                             const DebugSets& sets,
                             uint32_t light_count) {
    if (light_count == 0) {
        return;
    }
    if (!*lights_) {
        lights_ = gpu::makeGraphicsPipeline(
            device_, wiresInfo(shaders::light_wires_vert(), wires_layout_), "light wires");
    }
    bindWires(cmd, sets, lights_);
    cmd.draw(2 * io::kWireSegments * io::kWireCircles, light_count, 0, 0);
}

void DebugPass::recordClusters(const vk::raii::CommandBuffer& cmd,
                               const DebugSets& sets,
                               vk::Buffer vertices,
                               vk::DeviceSize offset,
                               uint32_t vertex_count) {
    if (!*clusters_) {
        auto info = wiresInfo(shaders::cluster_wires_vert(), wires_layout_);
        info.bindings = {{0, sizeof(io::WireVertex), vk::VertexInputRate::eVertex}};
        info.attributes = {{0, 0, vk::Format::eR32G32B32Sfloat, 0},
                           {1, 0, vk::Format::eR8G8B8A8Unorm, 12}};
        clusters_ = gpu::makeGraphicsPipeline(device_, info, "cluster wires");
    }
    bindWires(cmd, sets, clusters_);
    cmd.bindVertexBuffers(0, vertices, offset);
    cmd.draw(vertex_count, 1, 0, 0);
}

} // namespace froxel::render

#include "render/scene/debug_pass.h"

#include "embedded.h"
#include "gpu/pipeline.h"
#include "render/lists/pair_counter.h"
#include "render/pipelines/screen_groups.h"

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

// What the view's part of the shader looks at.
VariantKey valuesKey(settings::DebugView view,
                     uint32_t light_flags,
                     uint32_t output_flags,
                     bool device_is_cpu) {
    using View = settings::DebugView;
    const bool packed = view == View::kPosition || view == View::kNormal ||
                        view == View::kBaseColor || view == View::kRoughness;
    const bool lists = settings::countsLights(view) || settings::showsClusters(view);
    return {static_cast<uint32_t>(view), lists ? countingFlags(light_flags, device_is_cpu) : 0U,
            packed ? output_flags : 0U};
}

} // namespace

DebugPass::DebugPass(const gpu::Device& device,
                     const gpu::Timeline& timeline,
                     VariantMaker& maker,
                     const Pipelines& shared)
    : device_(device),
      values_layout_(gpu::makePipelineLayout(
          device, {shared.frameLayout(), shared.screenLayout()}, sizeof(io::DebugFrame))),
      wires_layout_(shared.screenPipelineLayout()), made_(timeline, maker, Pipelines::kKeptScreen) {
}

vk::Pipeline DebugPass::pipeline(DebugShader shader, const VariantKey& key) {
    return *made_.findOrMake(std::tuple(shader, key), [=, this] { return make(shader, key); });
}

vk::raii::Pipeline DebugPass::make(DebugShader shader, const VariantKey& key) const {
    switch (shader) {
    case DebugShader::kValues:
        return gpu::makeComputePipeline(device_, shaders::debug_view_comp(),
                                        specConstants(key, device_.traits()), *values_layout_,
                                        "debug view");
    case DebugShader::kLightWires:
        return gpu::makeGraphicsPipeline(
            device_, wiresInfo(shaders::light_wires_vert(), wires_layout_), "light wires");
    case DebugShader::kClusterWires:
        break;
    }
    auto info = wiresInfo(shaders::cluster_wires_vert(), wires_layout_);
    info.bindings = {{0, sizeof(io::WireVertex), vk::VertexInputRate::eVertex}};
    info.attributes = {{0, 0, vk::Format::eR32G32B32Sfloat, 0},
                       {1, 0, vk::Format::eR8G8B8A8Unorm, 12}};
    return gpu::makeGraphicsPipeline(device_, info, "cluster wires");
}

void DebugPass::recordValues(const vk::raii::CommandBuffer& cmd,
                             const DebugSets& sets,
                             settings::DebugView view,
                             uint32_t light_flags,
                             uint32_t output_flags,
                             const io::DebugFrame& values,
                             const vk::Rect2D& region) {
    cmd.bindPipeline(vk::PipelineBindPoint::eCompute,
                     pipeline(DebugShader::kValues,
                              valuesKey(view, light_flags, output_flags, device_.traits().is_cpu)));
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *values_layout_, 0, sets, {});
    cmd.pushConstants<io::DebugFrame>(*values_layout_, vk::ShaderStageFlagBits::eCompute, 0,
                                      values);
    dispatchOver(cmd, region);
}

void DebugPass::bindWires(const vk::raii::CommandBuffer& cmd,
                          const DebugSets& sets,
                          DebugShader shader) {
    cmd.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline(shader, {}));
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, wires_layout_, 0, sets, {});
}

void DebugPass::recordLights(const vk::raii::CommandBuffer& cmd,
                             const DebugSets& sets,
                             uint32_t first_light,
                             uint32_t light_count) {
    bindWires(cmd, sets, DebugShader::kLightWires);
    cmd.draw(2 * io::kLinesOfALight, light_count, 0, first_light);
}

void DebugPass::recordClusters(const vk::raii::CommandBuffer& cmd,
                               const DebugSets& sets,
                               vk::Buffer vertices,
                               vk::DeviceSize offset,
                               uint32_t first_vertex,
                               uint32_t vertex_count) {
    bindWires(cmd, sets, DebugShader::kClusterWires);
    cmd.bindVertexBuffers(0, vertices, offset);
    cmd.draw(vertex_count, 1, first_vertex, 0);
}

} // namespace froxel::render

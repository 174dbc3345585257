#include "render/fxaa.h"

#include "embedded.h"
#include "gpu/pipeline.h"
#include "render/screen_groups.h"

#include <array>

namespace froxel::render {

namespace {

using Type = vk::DescriptorType;

vk::raii::DescriptorSetLayout setLayout(const gpu::Device& device) {
    const auto stage = vk::ShaderStageFlagBits::eCompute;
    const std::array bindings = {
        vk::DescriptorSetLayoutBinding{0, Type::eUniformTexelBuffer, 1, stage},
        vk::DescriptorSetLayoutBinding{1, Type::eStorageBuffer, 1, stage}};
    return gpu::makeSetLayout(device, bindings);
}

vk::raii::DescriptorPool makePool(const gpu::Device& device) {
    const std::array sizes = {vk::DescriptorPoolSize{Type::eUniformTexelBuffer, 1},
                              vk::DescriptorPoolSize{Type::eStorageBuffer, 1}};
    return gpu::makeDescriptorPool(device, sizes);
}

} // namespace

FxaaPipeline::FxaaPipeline(const gpu::Device& device, const Pipelines& shared)
    : set_layout_(render::setLayout(device)),
      layout_(gpu::makePipelineLayout(device, {shared.frameLayout(), *set_layout_})),
      pipeline_(gpu::makeComputePipeline(device, shaders::fxaa_comp(), {}, *layout_, "fxaa")) {}

FxaaSlot::FxaaSlot(const gpu::Device& device, const FxaaPipeline& shared)
    : device_(device), pool_(makePool(device)) {
    set_ = gpu::makeSet(device, pool_, shared.setLayout());
}

void FxaaSlot::write(const gpu::Buffer& display, const gpu::Buffer& pixels) {
    texels_ = device_.handle().createBufferView({.buffer = *display.handle,
                                                 .format = vk::Format::eR32Uint,
                                                 .offset = 0,
                                                 .range = VK_WHOLE_SIZE});
    const vk::DescriptorBufferInfo buffer{*pixels.handle, 0, VK_WHOLE_SIZE};
    const std::array writes = {vk::WriteDescriptorSet{.dstSet = *set_,
                                                      .dstBinding = 0,
                                                      .descriptorCount = 1,
                                                      .descriptorType = Type::eUniformTexelBuffer,
                                                      .pTexelBufferView = &*texels_},
                               vk::WriteDescriptorSet{.dstSet = *set_,
                                                      .dstBinding = 1,
                                                      .descriptorCount = 1,
                                                      .descriptorType = Type::eStorageBuffer,
                                                      .pBufferInfo = &buffer}};
    device_.handle().updateDescriptorSets(writes, {});
}

void FxaaSlot::record(const vk::raii::CommandBuffer& cmd,
                      const FxaaPipeline& shared,
                      vk::DescriptorSet frame_set,
                      const vk::Rect2D& region) const {
    cmd.bindPipeline(vk::PipelineBindPoint::eCompute, shared.pipeline());
    const std::array sets = {frame_set, *set_};
    cmd.bindDescriptorSets(vk::PipelineBindPoint::eCompute, shared.layout(), 0, sets, {});
    dispatchOver(cmd, region);
}

} // namespace froxel::render

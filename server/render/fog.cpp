#include "render/fog.h"

#include "embedded.h"
#include "gpu/pipeline.h"

#include <algorithm>
#include <array>

namespace froxel::render {

namespace {

using Type = vk::DescriptorType;

vk::raii::DescriptorSetLayout makeSetLayout(const gpu::Device& device) {
    const std::array bindings = {vk::DescriptorSetLayoutBinding{0, Type::eStorageBuffer, 1,
                                                                vk::ShaderStageFlagBits::eCompute}};
    return gpu::makeSetLayout(device, bindings);
}

vk::raii::DescriptorPool makePool(const gpu::Device& device) {
    const vk::DescriptorPoolSize size{Type::eStorageBuffer, 1};
    return gpu::makeDescriptorPool(device, std::array{size});
}

} // namespace

FogPipelines::FogPipelines(const gpu::Device& device,
                           const gpu::Timeline& timeline,
                           VariantMaker& maker,
                           const Pipelines& shared)
    : device_(device), screen_layout_(shared.screenPipelineLayout()),
      set_layout_(makeSetLayout(device)),
      volume_layout_(gpu::makePipelineLayout(device, {shared.frameLayout(), *set_layout_})),
      made_(timeline, maker, Pipelines::kKeptScreen) {}

vk::Pipeline FogPipelines::pipeline(FogShader shader, const VariantKey& key) {
    return *made_.findOrMake(std::pair(shader, key), [=, this] {
        const gpu::SpecConstants constants = {key.material_flags, key.light_flags, key.output_flags,
                                              std::max(1U, device_.traits().subgroup_size)};
        switch (shader) {
        case FogShader::kScatter:
            return gpu::makeComputePipeline(device_, shaders::fog_scatter_comp(), constants,
                                            *volume_layout_, "fog scatter");
        case FogShader::kIntegrate:
            return gpu::makeComputePipeline(device_, shaders::fog_integrate_comp(), constants,
                                            *volume_layout_, "fog integrate");
        case FogShader::kApply:
            break;
        }
        return gpu::makeComputePipeline(device_, shaders::fog_comp(), constants, screen_layout_,
                                        "fog");
    });
}

FogVolume::FogVolume(const gpu::Device& device,
                     const FogPipelines& pipelines,
                     uint64_t froxel_count)
    : arena_(device), froxels_(arena_.makeBuffer(kFroxelBytes * froxel_count,
                                                 vk::BufferUsageFlagBits::eStorageBuffer |
                                                     vk::BufferUsageFlagBits::eUniformTexelBuffer,
                                                 gpu::MemoryUse::kDevice,
                                                 "fog volume")),
      pool_(makePool(device)) {
    set_ = gpu::makeSet(device, pool_, pipelines.setLayout());
    const vk::DescriptorBufferInfo buffer{*froxels_.handle, 0, VK_WHOLE_SIZE};
    device.handle().updateDescriptorSets(
        vk::WriteDescriptorSet{.dstSet = *set_,
                               .dstBinding = 0,
                               .descriptorCount = 1,
                               .descriptorType = Type::eStorageBuffer,
                               .pBufferInfo = &buffer},
        {});
}

std::shared_ptr<FogVolume> fogVolumeFor(const gpu::Device& device,
                                        const FogPipelines& pipelines,
                                        uint64_t froxel_count,
                                        std::shared_ptr<FogVolume> kept) {
    if (kept && kept->froxels().size_bytes == kFroxelBytes * froxel_count) {
        return kept;
    }
    kept.reset(); // before another is made
    return std::make_shared<FogVolume>(device, pipelines, froxel_count);
}

} // namespace froxel::render

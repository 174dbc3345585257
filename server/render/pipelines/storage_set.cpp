#include "render/pipelines/storage_set.h"

#include "gpu/pipeline.h"

#include <array>
#include <vector>

namespace froxel::render {

vk::raii::DescriptorSetLayout storageLayout(const gpu::Device& device, uint32_t count) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings(count);
    for (uint32_t i = 0; i < count; ++i) {
        bindings[i] = {.binding = i,
                       .descriptorType = vk::DescriptorType::eStorageBuffer,
                       .descriptorCount = 1,
                       .stageFlags = vk::ShaderStageFlagBits::eCompute};
    }
    return gpu::makeSetLayout(device, bindings);
}

StorageSet::StorageSet(const gpu::Device& device, vk::DescriptorSetLayout layout, uint32_t count)
    : device_(device),
      pool_(gpu::makeDescriptorPool(
          device, std::array{vk::DescriptorPoolSize{vk::DescriptorType::eStorageBuffer, count}})),
      set_(gpu::makeSet(device, pool_, layout)) {}

void StorageSet::write(std::span<const vk::DescriptorBufferInfo> buffers) const {
    device_.handle().updateDescriptorSets(
        vk::WriteDescriptorSet{.dstSet = *set_,
                               .dstBinding = 0,
                               .descriptorCount = static_cast<uint32_t>(buffers.size()),
                               .descriptorType = vk::DescriptorType::eStorageBuffer,
                               .pBufferInfo = buffers.data()},
        {});
}

} // namespace froxel::render

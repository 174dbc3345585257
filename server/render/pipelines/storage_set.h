// Descriptor sets of compute passes that have storage buffers alone, at bindings from 0 on.
#pragma once

#include "gpu/device.h"

#include <cstdint>
#include <span>

namespace froxel::render {

[[nodiscard]] vk::raii::DescriptorSetLayout storageLayout(const gpu::Device& device,
                                                          uint32_t count);

// One set with a pool of its own. The device outlives it.
class StorageSet {
  public:
    // `layout`: of so many.
    StorageSet(const gpu::Device& device, vk::DescriptorSetLayout layout, uint32_t count);

    // Describes all of them, in the order of bindings; not in flight.
    void write(std::span<const vk::DescriptorBufferInfo> buffers) const;
    [[nodiscard]] vk::DescriptorSet handle() const { return *set_; }

  private:
    const gpu::Device& device_;
    vk::raii::DescriptorPool pool_;
    vk::raii::DescriptorSet set_;
};

} // namespace froxel::render

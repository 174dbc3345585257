// Pipelines that pose vertices (mesh_poser.h).
#pragma once

#include "gpu/device.h"
#include "gpu/vulkan.h"

#include <cstdint>
#include <mutex>

namespace froxel::render {

class PosePipelines {
  public:
    static constexpr uint32_t kBindings = 12;

    // Throws vk::SystemError, and StartupError where the device binds too few buffers.
    explicit PosePipelines(const gpu::Device& device);

    [[nodiscard]] vk::DescriptorSetLayout setLayout() const { return *set_layout_; }
    [[nodiscard]] vk::PipelineLayout layout() const { return *layout_; }
    [[nodiscard]] vk::Pipeline vertices() const { return *vertices_; }
    // Made at the first call; any thread. Throws vk::SystemError.
    [[nodiscard]] vk::Pipeline flatNormals();

  private:
    const gpu::Device& device_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout layout_;
    vk::raii::Pipeline vertices_;
    std::mutex flat_mutex_;
    vk::raii::Pipeline flat_normals_{nullptr};
};

} // namespace froxel::render

// The compute pipelines of the light assignment on the device, made when a device first assigns.
#pragma once

#include "gpu/command_context.h"
#include "gpu/device.h"
#include "gpu/pipeline.h"

#include <array>
#include <string>
#include <vector>

namespace froxel::render {

enum class AssignPass : uint8_t {
    kLines,
    kBound,
    kCount,
    kSum,
    kPlace,
    kFill,
    kOrderShort,
    kOrderLong
};

class AssignPipelines {
  public:
    static constexpr uint32_t kPasses = 8;
    static constexpr uint32_t kBindings = 14; // storage buffers: shaders/lib/assign.glsl

    explicit AssignPipelines(const gpu::Device& device); // why() of it must be empty

    // Why the device cannot assign lights as the host does; empty: it can. Runs a small shader: the
    // lists are the same only where double division and square root round as the host's do, which
    // Vulkan leaves open.
    [[nodiscard]] static std::string unusable(const gpu::Device& device, gpu::Timeline& timeline);

    [[nodiscard]] vk::Pipeline pipeline(AssignPass pass) const {
        return *pipelines_[static_cast<size_t>(pass)];
    }
    [[nodiscard]] vk::DescriptorSetLayout setLayout() const { return *set_layout_; }
    [[nodiscard]] vk::PipelineLayout layout() const { return *layout_; }

  private:
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout layout_;
    std::vector<vk::raii::Pipeline> pipelines_;
};

} // namespace froxel::render

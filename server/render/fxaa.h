// The antialiasing filter over the finished picture; exists for views that ask for it.
#pragma once

#include "gpu/device.h"
#include "gpu/memory.h"
#include "render/pipelines.h"

namespace froxel::render {

// Shared by every view.
class FxaaPipeline {
  public:
    FxaaPipeline(const gpu::Device& device, const Pipelines& shared);

    [[nodiscard]] vk::DescriptorSetLayout setLayout() const { return *set_layout_; }
    [[nodiscard]] vk::PipelineLayout layout() const { return *layout_; }
    [[nodiscard]] vk::Pipeline pipeline() const { return *pipeline_; }

  private:
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout layout_;
    vk::raii::Pipeline pipeline_;
};

// One a frame slot.
class FxaaSlot {
  public:
    FxaaSlot(const gpu::Device& device, const FxaaPipeline& shared);

    // From the picture before it to where pixels are copied from or read; the slot is not in
    // flight.
    void write(const gpu::Buffer& display, const gpu::Buffer& pixels);
    void record(const vk::raii::CommandBuffer& cmd,
                const FxaaPipeline& shared,
                vk::DescriptorSet frame_set,
                const vk::Rect2D& region) const;

  private:
    const gpu::Device& device_;
    vk::raii::DescriptorPool pool_;
    vk::raii::DescriptorSet set_{nullptr};
    vk::raii::BufferView texels_{nullptr};
};

} // namespace froxel::render

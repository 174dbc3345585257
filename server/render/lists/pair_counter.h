// Counts light-pixel pairs on the device, for frames that ask for it; exists once one does.
#pragma once

#include "core/frame_stats.h"
#include "gpu/memory.h"
#include "interface/constants.h"
#include "render/pipelines/pipelines.h"

namespace froxel::render {

// Only what decides which lights a pixel is handed. They are counted one by one: a GPU, which would
// wait for each, fetches several at once.
[[nodiscard]] inline uint32_t countingFlags(uint32_t light_flags, bool device_is_cpu) {
    constexpr uint32_t kKept = io::kLightLocal | io::kLightLists | io::kLightSpots |
                               io::kLightEqualRadii | io::kLightLong | io::kLightSlicesLinear |
                               io::kLightSlicesHyperbolic;
    return (light_flags & kKept) | (device_is_cpu ? 0U : io::kLightLong);
}

// Shared by every view.
class PairPipelines {
  public:
    PairPipelines(const gpu::Device& device,
                  const gpu::Timeline& timeline,
                  VariantMaker& maker,
                  const Pipelines& shared);

    // May throw VariantsMissing.
    [[nodiscard]] vk::Pipeline pipeline(uint32_t light_flags);
    [[nodiscard]] vk::DescriptorSetLayout setLayout() const { return *set_layout_; }
    [[nodiscard]] vk::PipelineLayout layout() const { return *layout_; }

  private:
    const gpu::Device& device_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout layout_;
    VariantCache<uint32_t> made_;
};

// One a frame slot.
class PairCounter {
  public:
    PairCounter(const gpu::Device& device, const PairPipelines& shared);

    // Both record into a frame; a barrier lies between them. The sets are the slot's own.
    void recordClear(const vk::raii::CommandBuffer& cmd) const;
    void recordCount(const vk::raii::CommandBuffer& cmd,
                     PairPipelines& shared,
                     vk::DescriptorSet frame_set,
                     vk::DescriptorSet screen_set,
                     uint32_t light_flags,
                     const vk::Rect2D& region) const;
    // Of the frame recorded last, which has finished.
    [[nodiscard]] PairStats read() const;

  private:
    gpu::MemoryArena arena_;
    gpu::Buffer counts_;
    vk::raii::DescriptorPool pool_;
    vk::raii::DescriptorSet set_{nullptr};
};

} // namespace froxel::render

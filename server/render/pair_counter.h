// Counts light-pixel pairs on the device, for frames that ask for it: its pipeline, buffer and set
// exist from the first such frame on.
#pragma once

#include "core/frame_stats.h"
#include "gpu/memory.h"
#include "interface/constants.h"
#include "render/pipelines.h"

#include <optional>

namespace froxel::render {

// Only what decides which lights a pixel is handed.
inline constexpr uint32_t kListFlags = io::kLightLocal | io::kLightLists | io::kLightSpots |
                                       io::kLightEqualRadii | io::kLightLong |
                                       io::kLightSlicesLinear | io::kLightSlicesHyperbolic;

// One a frame slot.
class PairCounter {
  public:
    PairCounter(const gpu::Device& device, const Pipelines& shared);

    // Both record into a frame; a barrier lies between them. The sets are the slot's own.
    void recordClear(const vk::raii::CommandBuffer& cmd) const;
    void recordCount(const vk::raii::CommandBuffer& cmd,
                     vk::DescriptorSet frame_set,
                     vk::DescriptorSet screen_set,
                     uint32_t light_flags,
                     const vk::Rect2D& region);
    // Of the frame recorded last, which has finished.
    [[nodiscard]] PairStats read() const;

  private:
    const gpu::Device& device_;
    gpu::MemoryArena arena_;
    gpu::Buffer counts_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout layout_;
    vk::raii::DescriptorPool pool_;
    vk::raii::DescriptorSet set_{nullptr};
    std::optional<uint32_t> light_flags_; // of the pipeline
    vk::raii::Pipeline pipeline_{nullptr};
};

} // namespace froxel::render

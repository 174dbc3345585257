// Fog's pipelines and volume; they exist for views that ask for it.
#pragma once

#include "gpu/device.h"
#include "gpu/memory.h"
#include "render/fog_plan.h"
#include "render/pipelines.h"
#include "render/variant_cache.h"

#include <memory>
#include <utility>

namespace froxel::render {

enum class FogShader : uint8_t { kScatter, kIntegrate, kApply };

// Shared by every view; a pipeline is made when first needed.
class FogPipelines {
  public:
    FogPipelines(const gpu::Device& device,
                 const gpu::Timeline& timeline,
                 VariantMaker& maker,
                 const Pipelines& shared);

    [[nodiscard]] vk::Pipeline pipeline(FogShader shader, const VariantKey& key);
    // Of set 1 where the volume is written.
    [[nodiscard]] vk::DescriptorSetLayout setLayout() const { return *set_layout_; }
    // kApply has the screen passes' layout.
    [[nodiscard]] vk::PipelineLayout volumeLayout() const { return *volume_layout_; }

  private:
    const gpu::Device& device_;
    vk::PipelineLayout screen_layout_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout volume_layout_;
    VariantCache<std::pair<FogShader, VariantKey>> made_;
};

// One view's froxels. Frames in flight keep theirs alive.
class FogVolume {
  public:
    // Throws vk::OutOfDeviceMemoryError.
    FogVolume(const gpu::Device& device, const FogPipelines& pipelines, uint64_t froxel_count);

    [[nodiscard]] const gpu::Buffer& froxels() const { return froxels_; }
    [[nodiscard]] vk::DescriptorSet set() const { return *set_; }

  private:
    gpu::MemoryArena arena_;
    gpu::Buffer froxels_;
    vk::raii::DescriptorPool pool_;
    vk::raii::DescriptorSet set_{nullptr};
};

// `kept` where it has as many froxels, else another. Throws vk::OutOfDeviceMemoryError.
[[nodiscard]] std::shared_ptr<FogVolume> fogVolumeFor(const gpu::Device& device,
                                                      const FogPipelines& pipelines,
                                                      uint64_t froxel_count,
                                                      std::shared_ptr<FogVolume> kept);

} // namespace froxel::render

// Debug views on the device: their pipelines exist from the first frame on that asks for one.
#pragma once

#include "interface/debug_io.h"
#include "render/pipelines.h"

#include <array>
#include <optional>

namespace froxel::render {

// A slot's own: frame, screen.
using DebugSets = std::array<vk::DescriptorSet, 2>;

// One a frame slot, so that a pipeline is replaced when nothing uses it any more.
class DebugPass {
  public:
    DebugPass(const gpu::Device& device, const Pipelines& shared);

    // A value of each pixel, in the picture's place.
    void recordValues(const vk::raii::CommandBuffer& cmd,
                      const DebugSets& sets,
                      const VariantKey& key,
                      const io::DebugFrame& values,
                      const vk::Rect2D& region);
    // Both inside a rendering scope over radiance.
    void
    recordLights(const vk::raii::CommandBuffer& cmd, const DebugSets& sets, uint32_t light_count);
    void recordClusters(const vk::raii::CommandBuffer& cmd,
                        const DebugSets& sets,
                        vk::Buffer vertices, // io::WireVertex
                        vk::DeviceSize offset,
                        uint32_t vertex_count);

  private:
    void bindWires(const vk::raii::CommandBuffer& cmd,
                   const DebugSets& sets,
                   const vk::raii::Pipeline& pipeline) const;

    const gpu::Device& device_;
    vk::raii::PipelineLayout values_layout_;
    vk::PipelineLayout wires_layout_;
    std::optional<VariantKey> values_key_; // of the pipeline
    vk::raii::Pipeline values_{nullptr};
    vk::raii::Pipeline lights_{nullptr};
    vk::raii::Pipeline clusters_{nullptr};
};

} // namespace froxel::render

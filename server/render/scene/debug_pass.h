// Debug views on the device; exists once a view has asked for one.
#pragma once

#include "interface/debug_io.h"
#include "render/pipelines/pipelines.h"

#include <array>
#include <tuple>

namespace froxel::render {

// A slot's own: frame, screen.
using DebugSets = std::array<vk::DescriptorSet, 2>;

enum class DebugShader : uint8_t { kValues, kLightWires, kClusterWires };

// Shared by every view. The functions that record may throw VariantsMissing.
class DebugPass {
  public:
    DebugPass(const gpu::Device& device,
              const gpu::Timeline& timeline,
              VariantMaker& maker,
              const Pipelines& shared);

    // A value of each pixel, in the picture's place. Flags: how lights are listed, and how the
    // G-buffer is packed.
    void recordValues(const vk::raii::CommandBuffer& cmd,
                      const DebugSets& sets,
                      settings::DebugView view,
                      uint32_t light_flags,
                      uint32_t output_flags,
                      const io::DebugFrame& values,
                      const vk::Rect2D& region);
    // Both inside a rendering scope over radiance.
    void recordLights(const vk::raii::CommandBuffer& cmd,
                      const DebugSets& sets,
                      uint32_t first_light,
                      uint32_t light_count);
    void recordClusters(const vk::raii::CommandBuffer& cmd,
                        const DebugSets& sets,
                        vk::Buffer vertices, // io::WireVertex
                        vk::DeviceSize offset,
                        uint32_t first_vertex,
                        uint32_t vertex_count);

  private:
    [[nodiscard]] vk::Pipeline pipeline(DebugShader shader, const VariantKey& key);
    [[nodiscard]] vk::raii::Pipeline make(DebugShader shader, const VariantKey& key) const;
    void bindWires(const vk::raii::CommandBuffer& cmd, const DebugSets& sets, DebugShader shader);

    const gpu::Device& device_;
    vk::raii::PipelineLayout values_layout_;
    vk::PipelineLayout wires_layout_;
    VariantCache<std::tuple<DebugShader, VariantKey>> made_;
};

} // namespace froxel::render

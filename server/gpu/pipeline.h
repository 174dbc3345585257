// Shader modules and pipelines from embedded SPIR-V.
#pragma once

#include "gpu/device.h"

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>
#include <vector>

namespace froxel::gpu {

using Spirv = std::span<const uint32_t>;

// Specialisation constants: id i takes values[i] (32-bit each; booleans as 0 or 1).
using SpecConstants = std::vector<uint32_t>;

enum class Blend : uint8_t {
    kNone,
    kOver, // source over destination, premultiplied
    kAdd,
    kUnder,    // source under destination, both premultiplied
    kDim,      // colours are multiplied, the larger alpha stays
    kWeighted, // colours are added, destination alpha is multiplied by 1 - source alpha
};

struct GraphicsPipelineInfo {
    Spirv vertex;
    Spirv fragment; // empty: depth only
    SpecConstants constants;
    vk::PipelineLayout layout;
    std::vector<vk::VertexInputBindingDescription> bindings;
    std::vector<vk::VertexInputAttributeDescription> attributes;
    std::vector<vk::Format> color_formats;
    vk::Format depth_format = vk::Format::eUndefined;
    vk::CompareOp depth_compare = vk::CompareOp::eGreaterOrEqual; // reversed-Z; of equal depths
                                                                  // the last drawn stays
    bool depth_write = true;
    Blend blend = Blend::kNone;
    bool lines = false; // pairs of vertices instead of triangles
};

// Cull mode, front face, viewport and scissor are dynamic.
[[nodiscard]] vk::raii::Pipeline
makeGraphicsPipeline(const Device& device, const GraphicsPipelineInfo& info, std::string_view name);

[[nodiscard]] vk::raii::Pipeline makeComputePipeline(const Device& device,
                                                     Spirv code,
                                                     const SpecConstants& constants,
                                                     vk::PipelineLayout layout,
                                                     std::string_view name);

[[nodiscard]] vk::raii::DescriptorSetLayout
makeSetLayout(const Device& device, std::span<const vk::DescriptorSetLayoutBinding> bindings);

// Its sets end before it does.
[[nodiscard]] vk::raii::DescriptorPool makeDescriptorPool(
    const Device& device, std::span<const vk::DescriptorPoolSize> sizes, uint32_t max_sets = 1);

[[nodiscard]] vk::raii::DescriptorSet
makeSet(const Device& device, const vk::raii::DescriptorPool& pool, vk::DescriptorSetLayout layout);

// Sets from 0 on; push constants from offset 0.
[[nodiscard]] vk::raii::PipelineLayout
makePipelineLayout(const Device& device,
                   std::initializer_list<vk::DescriptorSetLayout> sets,
                   uint32_t push_bytes = 0,
                   vk::ShaderStageFlags push_stages = vk::ShaderStageFlagBits::eCompute);

} // namespace froxel::gpu

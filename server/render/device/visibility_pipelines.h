// Pipelines and layouts of the visibility passes. Sets: 0 frame; 1 material (raster) or screen
// (resolve); 2 geometry and draws; 3 every texture of the scene, or one material's; 4 what is
// behind surfaces that transmit light.
#pragma once

#include "render/pipelines/pipelines.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace froxel::render {

class VisibilityPipelines {
  public:
    // Of set 2: geometry and draws, 13; ids, G-buffer; what compute rasters by, 4; its depth, ids;
    // details of meshlets, meshlets, their words; farthest depths, or tiles of layers.
    static constexpr uint32_t kBindings = 25;
    static constexpr vk::Format kIdFormat = vk::Format::eR32Uint;

    [[nodiscard]] static constexpr vk::DescriptorType bindingType(uint32_t binding) {
        return binding == 13 ? vk::DescriptorType::eSampledImage
               : binding == 14 || binding == 19 || binding == 20
                   ? vk::DescriptorType::eStorageImage
                   : vk::DescriptorType::eStorageBuffer;
    }

    // texture_count: of the whole scene; 0 where materials are bound one at a time.
    VisibilityPipelines(const gpu::Device& device,
                        const gpu::Timeline& timeline,
                        VariantMaker& maker,
                        const Pipelines& shared,
                        uint32_t texture_count);

    // All of these may throw VariantsMissing.
    // Depth and ids. material_flags: of a masked material, else of its faces alone.
    [[nodiscard]] vk::Pipeline raster(MaterialFlags material_flags);
    // From ids to the G-buffer, and from ids to radiance.
    [[nodiscard]] vk::Pipeline gbuffer(const VariantKey& key);
    [[nodiscard]] vk::Pipeline shade(const VariantKey& key);
    // From ids of a layer of surfaces that transmit light to radiance over what is behind, with
    // transmissionLayout(); where the device binds enough for it.
    [[nodiscard]] static bool canShadeTransmission(const gpu::Device& device);
    [[nodiscard]] vk::Pipeline shadeTransmission(const VariantKey& key);
    // detail: of meshes with coarser levels.
    [[nodiscard]] vk::Pipeline cull(bool detail);
    [[nodiscard]] vk::Pipeline compact() const { return *compact_; }
    // Ids rastered in compute (compute_raster.h). Peeled: of several layers of a pixel.
    // material_flags: of masked materials; 0: opaque.
    enum class ComputeStep : uint8_t {
        kCullDetail,
        kCullList,
        kCullListDetail,
        kMeshlets,
        kManyMeshlets,
        kBlocks,
        kFar,
        kHidden,
        kUnpack,
        kPeeledMeshlets,
        kPeeledBlocks,
        kLayerTiles,
        kLayerTilesDepth
    };
    [[nodiscard]] vk::Pipeline compute(ComputeStep step, MaterialFlags material_flags = 0);

    // The variants kept that shade.
    [[nodiscard]] std::vector<Pipelines::Made> made() const;

    [[nodiscard]] bool bindless() const { return bindless_; }
    [[nodiscard]] vk::DescriptorSetLayout setLayout() const { return *set_layout_; }
    [[nodiscard]] vk::DescriptorSetLayout textureLayout() const { return *texture_layout_; }
    [[nodiscard]] vk::PipelineLayout rasterLayout() const { return *raster_layout_; }
    [[nodiscard]] vk::PipelineLayout computeLayout() const { return *compute_layout_; }
    [[nodiscard]] vk::PipelineLayout transmissionLayout() const { return *transmission_layout_; }

    [[nodiscard]] gpu::SpecConstants constants(const VariantKey& key) const;

  private:
    [[nodiscard]] vk::raii::Pipeline makeRaster(MaterialFlags material_flags) const;

    const gpu::Device& device_;
    bool bindless_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::DescriptorSetLayout texture_layout_;
    vk::raii::PipelineLayout raster_layout_;
    vk::raii::PipelineLayout compute_layout_;
    vk::raii::PipelineLayout transmission_layout_; // null: !canShadeTransmission()
    vk::raii::Pipeline cull_;
    vk::raii::Pipeline compact_;
    VariantCache<MaterialFlags> raster_;
    VariantCache<VariantKey> gbuffer_;
    VariantCache<VariantKey> shade_;
    VariantCache<VariantKey> shade_transmission_;
    VariantCache<std::pair<ComputeStep, MaterialFlags>> compute_;
};

} // namespace froxel::render

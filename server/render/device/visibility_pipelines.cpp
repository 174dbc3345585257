#include "render/device/visibility_pipelines.h"

#include "embedded.h"
#include "interface/constants.h"
#include "render/pipelines/texture_limit.h"

#include <algorithm>
#include <array>
#include <span>

namespace froxel::render {

namespace {

using Stage = vk::ShaderStageFlagBits;

vk::raii::DescriptorSetLayout geometryLayout(const gpu::Device& device) {
    std::array<vk::DescriptorSetLayoutBinding, VisibilityPipelines::kBindings> bindings;
    for (uint32_t i = 0; i < bindings.size(); ++i) {
        const bool vertex = i == 4 || i == 5 || i == 8; // items, placed meshlets, instances
        bindings[i] = {.binding = i,
                       .descriptorType = VisibilityPipelines::bindingType(i),
                       .descriptorCount = 1,
                       .stageFlags = vertex ? Stage::eVertex | Stage::eCompute
                                            : vk::ShaderStageFlags(Stage::eCompute)};
    }
    return gpu::makeSetLayout(device, bindings);
}

vk::raii::DescriptorSetLayout texturesLayout(const gpu::Device& device, uint32_t count) {
    const std::array bindings = {vk::DescriptorSetLayoutBinding{
        0, vk::DescriptorType::eCombinedImageSampler, std::max(1U, count), Stage::eCompute}};
    return gpu::makeSetLayout(device, bindings);
}

gpu::Spirv shadeShader(bool layered, bool bindless, bool batched) {
    using namespace shaders;
    if (layered) {
        return bindless ? (batched ? visibility_shade_layered_batched_bindless_comp()
                                   : visibility_shade_layered_bindless_comp())
                        : (batched ? visibility_shade_layered_batched_comp()
                                   : visibility_shade_layered_comp());
    }
    return bindless ? (batched ? visibility_shade_batched_bindless_comp()
                               : visibility_shade_bindless_comp())
                    : (batched ? visibility_shade_batched_comp() : visibility_shade_comp());
}

gpu::Spirv shadeTransmissionShader(bool bindless, bool batched) {
    using namespace shaders;
    return bindless ? (batched ? visibility_shade_transmission_batched_bindless_comp()
                               : visibility_shade_transmission_bindless_comp())
                    : (batched ? visibility_shade_transmission_batched_comp()
                               : visibility_shade_transmission_comp());
}

using Step = VisibilityPipelines::ComputeStep;

gpu::Spirv computeShader(Step step, bool bindless) {
    switch (step) {
    case Step::kCullDetail:
        return shaders::cull_meshlets_detail_comp();
    case Step::kCullList:
        return shaders::cull_list_comp();
    case Step::kCullListDetail:
        return shaders::cull_list_detail_comp();
    case Step::kMeshlets:
        return bindless ? shaders::raster_meshlets_bindless_comp()
                        : shaders::raster_meshlets_comp();
    case Step::kManyMeshlets:
        return bindless ? shaders::raster_many_bindless_comp() : shaders::raster_many_comp();
    case Step::kBlocks:
        return bindless ? shaders::raster_blocks_bindless_comp() : shaders::raster_blocks_comp();
    case Step::kFar:
        return shaders::raster_far_comp();
    case Step::kHidden:
        return shaders::raster_hidden_comp();
    case Step::kPeeledMeshlets:
        return bindless ? shaders::raster_meshlets_peeled_bindless_comp()
                        : shaders::raster_meshlets_peeled_comp();
    case Step::kPeeledBlocks:
        return bindless ? shaders::raster_blocks_peeled_bindless_comp()
                        : shaders::raster_blocks_peeled_comp();
    case Step::kLayerTiles:
        return shaders::layer_tiles_comp();
    case Step::kLayerTilesDepth:
        return shaders::layer_tiles_depth_comp();
    case Step::kUnpack:
        break;
    }
    return shaders::raster_unpack_comp();
}

const char* nameOf(Step step) {
    switch (step) {
    case Step::kCullDetail:
        return "cull (detail)";
    case Step::kCullList:
        return "cull (list)";
    case Step::kCullListDetail:
        return "cull (list, detail)";
    case Step::kMeshlets:
        return "raster meshlets";
    case Step::kManyMeshlets:
        return "raster meshlets (many)";
    case Step::kBlocks:
        return "raster blocks";
    case Step::kFar:
        return "farthest depths";
    case Step::kHidden:
        return "hidden meshlets";
    case Step::kPeeledMeshlets:
        return "raster meshlets (peeled)";
    case Step::kPeeledBlocks:
        return "raster blocks (peeled)";
    case Step::kLayerTiles:
        return "tiles of layers";
    case Step::kLayerTilesDepth:
        return "tiles and depth of layers";
    case Step::kUnpack:
        break;
    }
    return "unpack ids";
}

} // namespace

bool VisibilityPipelines::canShadeTransmission(const gpu::Device& device) {
    constexpr uint32_t kSets = 5;
    return device.limits().maxBoundDescriptorSets >= kSets &&
           device.traits().most_textures >=
               kPassTextures + kBehindTextures + materialSlots(device.traits());
}

VisibilityPipelines::VisibilityPipelines(const gpu::Device& device,
                                         const gpu::Timeline& timeline,
                                         VariantMaker& maker,
                                         const Pipelines& shared,
                                         uint32_t texture_count)
    : device_(device), bindless_(texture_count > 0), set_layout_(geometryLayout(device)),
      texture_layout_(texturesLayout(device, texture_count)), raster_layout_(nullptr),
      compute_layout_(nullptr), transmission_layout_(nullptr), cull_(nullptr), compact_(nullptr),
      raster_(timeline, maker, Pipelines::kKeptGeometry),
      gbuffer_(timeline, maker, Pipelines::kKeptGeometry),
      shade_(timeline, maker, Pipelines::kKeptGeometry),
      shade_transmission_(timeline, maker, Pipelines::kKeptGeometry),
      compute_(timeline, maker, Pipelines::kKeptGeometry) {
    raster_layout_ = gpu::makePipelineLayout(
        device, {shared.frameLayout(), shared.materialLayout(), *set_layout_});
    constexpr uint32_t kPushed = 2 * sizeof(uint32_t);
    const auto textures = bindless_ ? *texture_layout_ : shared.materialLayout();
    compute_layout_ = gpu::makePipelineLayout(
        device, {shared.frameLayout(), shared.screenLayout(), *set_layout_, textures}, kPushed);
    if (canShadeTransmission(device)) {
        transmission_layout_ =
            gpu::makePipelineLayout(device,
                                    {shared.frameLayout(), shared.screenLayout(), *set_layout_,
                                     textures, shared.transmissionSetLayout()},
                                    kPushed);
    }
    cull_ = gpu::makeComputePipeline(device, shaders::cull_meshlets_comp(), constants({}),
                                     *compute_layout_, "cull");
    compact_ = gpu::makeComputePipeline(device, shaders::cull_compact_comp(), constants({}),
                                        *compute_layout_, "compact");
}

gpu::SpecConstants VisibilityPipelines::constants(const VariantKey& key) const {
    return specConstants(key, device_.traits());
}

vk::raii::Pipeline VisibilityPipelines::makeRaster(MaterialFlags material_flags) const {
    using Format = vk::Format;
    const bool masked = (material_flags & io::kMaterialMask) != 0;
    const bool extended = masked && (material_flags & io::kMaterialExtended) != 0;
    gpu::GraphicsPipelineInfo info;
    info.constants = fragmentConstants({masked ? material_flags : 0U, 0, 0}, device_.traits());
    info.layout = *raster_layout_;
    info.color_formats = {kIdFormat};
    info.depth_format = Pipelines::kDepthFormat;
    info.bindings = {{0, 12, vk::VertexInputRate::eVertex}};
    info.attributes = {{0, 0, Format::eR32G32B32Sfloat, 0}};
    info.vertex = shaders::visibility_vert();
    info.fragment = shaders::visibility_frag();
    if (masked) {
        info.bindings.push_back({1, 20, vk::VertexInputRate::eVertex});
        info.attributes.push_back({2, 1, Format::eR32G32Sfloat, 12});
        info.vertex = shaders::visibility_masked_vert();
        info.fragment = shaders::visibility_masked_frag();
    }
    if (extended) {
        info.bindings.push_back({2, 40, vk::VertexInputRate::eVertex});
        info.attributes.push_back({6, 2, Format::eR32G32Sfloat, 0});
        info.attributes.push_back({7, 2, Format::eR32G32B32A32Sfloat, 8});
        info.vertex = shaders::visibility_masked_extended_vert();
        info.fragment = shaders::visibility_masked_extended_frag();
    }
    return gpu::makeGraphicsPipeline(device_, info, "visibility");
}

vk::Pipeline VisibilityPipelines::raster(MaterialFlags material_flags) {
    const bool masked = (material_flags & io::kMaterialMask) != 0;
    const MaterialFlags key = masked ? material_flags : 0U;
    return *raster_.findOrMake(key, [=, this] { return makeRaster(key); });
}

vk::Pipeline VisibilityPipelines::cull(bool detail) {
    return detail ? compute(ComputeStep::kCullDetail) : *cull_;
}

vk::Pipeline VisibilityPipelines::gbuffer(const VariantKey& key) {
    return *gbuffer_.findOrMake(key, [=, this] {
        return gpu::makeComputePipeline(device_,
                                        bindless_ ? shaders::visibility_gbuffer_bindless_comp()
                                                  : shaders::visibility_gbuffer_comp(),
                                        constants(key), *compute_layout_, "visibility to G-buffer");
    });
}

vk::Pipeline VisibilityPipelines::shade(const VariantKey& key) {
    return *shade_.findOrMake(key, [=, this] {
        const bool batched = (key.light_flags & io::kLightBatched) != 0;
        const bool layered = (key.material_flags & io::kMaterialLayers) != 0;
        return gpu::makeComputePipeline(device_, shadeShader(layered, bindless_, batched),
                                        constants(key), *compute_layout_, "visibility to radiance");
    });
}

vk::Pipeline VisibilityPipelines::shadeTransmission(const VariantKey& key) {
    return *shade_transmission_.findOrMake(key, [=, this] {
        const bool batched = (key.light_flags & io::kLightBatched) != 0;
        return gpu::makeComputePipeline(device_, shadeTransmissionShader(bindless_, batched),
                                        constants(key), *transmission_layout_, "layer to radiance");
    });
}

vk::Pipeline VisibilityPipelines::compute(ComputeStep step, MaterialFlags material_flags) {
    return *compute_.findOrMake({step, material_flags}, [=, this] {
        return gpu::makeComputePipeline(device_, computeShader(step, bindless_),
                                        constants({material_flags, 0, 0}), *compute_layout_,
                                        nameOf(step));
    });
}

std::vector<Pipelines::Made> VisibilityPipelines::made() const {
    std::vector<Pipelines::Made> all;
    gbuffer_.forEachKey([&](const auto& key) { all.push_back({"visibility gbuffer", key}); });
    shade_.forEachKey([&](const auto& key) { all.push_back({"visibility shade", key}); });
    shade_transmission_.forEachKey([&](const auto& key) {
        all.push_back({"visibility transmission", key});
    });
    return all;
}

} // namespace froxel::render

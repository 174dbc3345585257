// The pipelines in use, made when first needed: a variant is three words of flags.
#pragma once

#include "gpu/device.h"
#include "gpu/pipeline.h"
#include "interface/constants.h"
#include "interface/frame_bindings.h"
#include "render/pipelines/material_flags.h"
#include "render/pipelines/variant_cache.h"
#include "settings/settings.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

namespace froxel::render {

enum class GeometryPass : uint8_t {
    kDepth,             // prepass
    kGbuffer,           // geometry pass of the deferred renderers
    kGbufferAfterDepth, // likewise where the prepass left the same depth
    kForward,           // forward, writing depth
    kForwardAfterDepth, // forward where the prepass left the same depth
    kTransparent,       // forward, blended, over finished depth
    kTransparentBehind, // likewise, behind what transmits light
    kWeighted,          // forward, summed by weights
    kPeelSelect,        // which triangle each pixel's next layer is of
    kPeelShade,         // forward, that layer under those before
    kPeelCount,         // pixels that have yet another
    kTransmissionDepth, // which surface that transmits light each pixel's next layer is
    kTransmission,      // forward, that layer over what is behind it
    kTransmittance,     // of shadow maps: what passes surfaces that transmit light
    kOverdraw,          // counts fragments, writing depth
    kInstances,         // whose the nearest fragment is, writing depth
};

// Peeling passes tell triangles apart.
[[nodiscard]] constexpr bool peels(GeometryPass pass) {
    return pass == GeometryPass::kPeelSelect || pass == GeometryPass::kPeelShade ||
           pass == GeometryPass::kPeelCount;
}

// Passes that no material has a say in, but one with holes.
[[nodiscard]] constexpr bool depthOnly(GeometryPass pass) {
    return pass == GeometryPass::kDepth || pass == GeometryPass::kOverdraw ||
           pass == GeometryPass::kInstances || pass == GeometryPass::kPeelSelect ||
           pass == GeometryPass::kPeelCount || pass == GeometryPass::kTransmissionDepth;
}

// Passes of surfaces that transmit light, which read what is behind them.
[[nodiscard]] constexpr bool transmits(GeometryPass pass) {
    return pass == GeometryPass::kTransmissionDepth || pass == GeometryPass::kTransmission;
}

// Passes that draw one by one, with push constants.
[[nodiscard]] constexpr bool tellsDraws(GeometryPass pass) {
    return peels(pass) || pass == GeometryPass::kInstances;
}

// Fragments of such a material may show nothing.
[[nodiscard]] constexpr bool hasHoles(MaterialFlags material_flags) {
    return (material_flags & (io::kMaterialMask | io::kMaterialBlend)) != 0;
}

// Which specialisation a pipeline has (shaders/interface/constants.h).
struct VariantKey {
    MaterialFlags material_flags = 0;
    uint32_t light_flags = 0;
    uint32_t output_flags = 0;
    auto operator<=>(const VariantKey&) const = default;
};

struct FrameBinding {
    vk::DescriptorType type;
    vk::Format texels = vk::Format::eUndefined; // of a texel buffer
};
// By the bindings of interface/frame_bindings.h.
inline constexpr auto kFrameBindings = [] {
    using Type = vk::DescriptorType;
    constexpr auto kTexels = Type::eUniformTexelBuffer;
    std::array<FrameBinding, io::kFrameBindingCount> all{};
    all[io::kFrameBinding] = {Type::eUniformBuffer};
    all[io::kLightsBinding] = {kTexels, vk::Format::eR32G32B32A32Sfloat};
    all[io::kListsBinding] = {kTexels, vk::Format::eR32G32Uint};
    all[io::kIndicesBinding] = {kTexels, vk::Format::eR32Uint};
    all[io::kSpotsBinding] = {kTexels, vk::Format::eR32G32B32A32Sfloat};
    all[io::kSunsBinding] = {Type::eStorageBuffer};
    all[io::kFogBinding] = {Type::eUniformBuffer};
    all[io::kFogVolumeBinding] = {kTexels, vk::Format::eR32G32B32A32Sfloat};
    all[io::kShadowOfLightBinding] = {kTexels, vk::Format::eR32Uint};
    all[io::kShadowLightsBinding] = {kTexels, vk::Format::eR32G32B32A32Sfloat};
    all[io::kShadowAtlasBinding] = {Type::eSampledImage};
    all[io::kAreasBinding] = {kTexels, vk::Format::eR32G32B32A32Sfloat};
    all[io::kLtcBinding] = {kTexels, vk::Format::eR32G32B32A32Sfloat};
    all[io::kEnvironmentBinding] = {Type::eUniformBuffer};
    all[io::kLevelsBinding] = {kTexels, vk::Format::eR32G32B32A32Sfloat};
    all[io::kLobesBinding] = {kTexels, vk::Format::eR32G32Sfloat};
    all[io::kTransmissiveDepthBinding] = {Type::eSampledImage};
    all[io::kTransmittanceAtlasBinding] = {Type::eSampledImage};
    return all;
}();

[[nodiscard]] gpu::SpecConstants specConstants(const VariantKey& key,
                                               const gpu::DeviceTraits& device);
// Of passes that sample materials in the fragment stage.
[[nodiscard]] gpu::SpecConstants fragmentConstants(VariantKey key, const gpu::DeviceTraits& device);

class Pipelines {
  public:
    static constexpr vk::Format kDepthFormat = vk::Format::eD32Sfloat;
    static constexpr vk::Format kRadianceFormat = vk::Format::eR32G32B32A32Sfloat;
    static constexpr vk::Format kBlendWeightFormat = vk::Format::eR32Sfloat;
    static constexpr vk::Format kTransmittanceFormat = vk::Format::eR16G16B16A16Sfloat;
    static constexpr vk::Format kPeelKeyFormat = vk::Format::eR32G32Uint; // depth's bits, order
    // Variants kept: of surfaces, where a frame takes one for each kind of material, and of passes
    // over the picture. llvmpipe takes 4 MB for one.
    static constexpr size_t kKeptGeometry = 48;
    static constexpr size_t kKeptScreen = 16;

    Pipelines(const gpu::Device& device, const gpu::Timeline& timeline, VariantMaker& maker);

    // These may throw VariantsMissing.
    [[nodiscard]] vk::Pipeline geometry(GeometryPass pass, const VariantKey& key);
    // Whether geometry() has it; asks for it where not.
    [[nodiscard]] bool prepareGeometry(GeometryPass pass, const VariantKey& key);
    // geometry() has it and has not given it yet: a software device compiles it when it draws.
    [[nodiscard]] bool isNewGeometry(GeometryPass pass, const VariantKey& key) const {
        return geometry_.isNew(std::tuple(pass, key));
    }
    // What was blended apart, over the picture.
    [[nodiscard]] vk::Pipeline blendResolve(settings::Transparency transparency);
    // The same where some of the picture is unlit, in compute.
    [[nodiscard]] vk::Pipeline blendOverUnlit(settings::Transparency transparency,
                                              uint32_t output_flags);

    // The variants kept of these.
    struct Made {
        std::string_view pass;
        VariantKey key;
    };
    [[nodiscard]] std::vector<Made> made() const;

    [[nodiscard]] vk::DescriptorSetLayout frameLayout() const { return *frame_layout_; }
    [[nodiscard]] vk::DescriptorSetLayout materialLayout() const { return *material_layout_; }
    [[nodiscard]] vk::DescriptorSetLayout screenLayout() const { return *screen_set_layout_; }
    // Two sampled images: peeling's solid depth and keys, or what the resolve reads.
    [[nodiscard]] vk::DescriptorSetLayout blendSetLayout() const { return *blend_set_layout_; }
    [[nodiscard]] vk::PipelineLayout blendResolveLayout() const { return *resolve_layout_; }
    // Frame, screen, and what the resolve reads.
    [[nodiscard]] vk::PipelineLayout blendOverUnlitLayout() const { return *over_unlit_layout_; }
    [[nodiscard]] vk::PipelineLayout geometryPipelineLayout() const { return *geometry_layout_; }
    // As that, a blend set of passes that peel, and push constants of passes that tell draws.
    [[nodiscard]] vk::PipelineLayout toldPipelineLayout() const { return *told_layout_; }
    // Two sampled images and a combined one: solid depth, the layer before, the picture behind.
    [[nodiscard]] vk::DescriptorSetLayout transmissionSetLayout() const {
        return *transmission_set_layout_;
    }
    // As geometryPipelineLayout(), and such a set.
    [[nodiscard]] vk::PipelineLayout transmissionPipelineLayout() const {
        return *transmission_layout_;
    }
    // Of a pass that draws geometry.
    [[nodiscard]] vk::PipelineLayout layoutOf(GeometryPass pass) const {
        return tellsDraws(pass)  ? *told_layout_
               : transmits(pass) ? *transmission_layout_
                                 : *geometry_layout_;
    }
    [[nodiscard]] vk::PipelineLayout screenPipelineLayout() const { return *screen_layout_; }

    [[nodiscard]] static vk::Format gbufferFormat(uint32_t output_flags) {
        return (output_flags & io::kOutputWideGbuffer) != 0 ? vk::Format::eR32G32B32A32Uint
                                                            : vk::Format::eR32G32Uint;
    }

  private:
    [[nodiscard]] gpu::SpecConstants constants(const VariantKey& key) const {
        return specConstants(key, device_.traits());
    }
    [[nodiscard]] vk::raii::Pipeline makeGeometry(GeometryPass pass, const VariantKey& key) const;

    const gpu::Device& device_;
    vk::raii::DescriptorSetLayout frame_layout_;
    vk::raii::DescriptorSetLayout material_layout_;
    vk::raii::DescriptorSetLayout screen_set_layout_;
    vk::raii::PipelineLayout geometry_layout_;
    vk::raii::PipelineLayout screen_layout_;
    vk::raii::DescriptorSetLayout blend_set_layout_;
    vk::raii::PipelineLayout told_layout_;
    vk::raii::DescriptorSetLayout transmission_set_layout_;
    vk::raii::PipelineLayout transmission_layout_;
    vk::raii::PipelineLayout resolve_layout_;
    vk::raii::PipelineLayout over_unlit_layout_;
    VariantCache<settings::Transparency> blend_resolve_;
    VariantCache<std::tuple<bool, uint32_t>> blend_over_unlit_;
    VariantCache<std::tuple<GeometryPass, VariantKey>> geometry_;
};

} // namespace froxel::render

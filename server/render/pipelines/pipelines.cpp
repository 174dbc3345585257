#include "render/pipelines/pipelines.h"

#include "embedded.h"
#include "interface/constants.h"
#include "interface/peel_io.h"
#include "interface/visibility_io.h"
#include "render/pipelines/gbuffer_layout.h"
#include "render/pipelines/texture_limit.h"

#include <algorithm>
#include <array>

namespace froxel::render {

namespace {

using Stage = vk::ShaderStageFlagBits;
using Type = vk::DescriptorType;

constexpr std::array<std::string_view, 16> kGeometryNames = {"depth prepass",
                                                             "gbuffer",
                                                             "gbuffer after depth",
                                                             "forward",
                                                             "forward after depth",
                                                             "transparent",
                                                             "transparent behind",
                                                             "weighted",
                                                             "peel select",
                                                             "peel shade",
                                                             "peel count",
                                                             "transmission depth",
                                                             "transmission",
                                                             "transmittance",
                                                             "overdraw",
                                                             "instances"};
constexpr std::string_view kBlendResolveName = "blend resolve";
constexpr std::string_view kBlendOverUnlitName = "blend over unlit";

constexpr vk::ShaderStageFlags kAllStages = Stage::eVertex | Stage::eFragment | Stage::eCompute;

vk::raii::DescriptorSetLayout frameSetLayout(const gpu::Device& device) {
    std::array<vk::DescriptorSetLayoutBinding, io::kFrameBindingCount> bindings;
    for (uint32_t i = 0; i < bindings.size(); ++i) {
        bindings[i] = {.binding = i,
                       .descriptorType = kFrameBindings[i].type,
                       .descriptorCount = 1,
                       .stageFlags = kAllStages};
    }
    return gpu::makeSetLayout(device, bindings);
}

vk::raii::DescriptorSetLayout materialSetLayout(const gpu::Device& device) {
    // Uniforms, textures.
    std::vector<vk::DescriptorSetLayoutBinding> bindings(1 + materialSlots(device.traits()));
    for (uint32_t i = 0; i < bindings.size(); ++i) {
        bindings[i] = {.binding = i,
                       .descriptorType =
                           i == 0 ? Type::eUniformBuffer : Type::eCombinedImageSampler,
                       .descriptorCount = 1,
                       .stageFlags = Stage::eFragment | Stage::eCompute};
    }
    return gpu::makeSetLayout(device, bindings);
}

constexpr vk::ShaderStageFlags kScreenStages = Stage::eFragment | Stage::eCompute;
constexpr std::array kScreenBindings = {
    vk::DescriptorSetLayoutBinding{0, Type::eSampledImage, 1, kScreenStages},
    vk::DescriptorSetLayoutBinding{1, Type::eSampledImage, 1, kScreenStages},
    vk::DescriptorSetLayoutBinding{2, Type::eStorageImage, 1, Stage::eCompute},
    vk::DescriptorSetLayoutBinding{3, Type::eStorageBuffer, 1, Stage::eCompute},
    vk::DescriptorSetLayoutBinding{4, Type::eSampledImage, 1, kScreenStages}};

constexpr bool isTexture(Type type) {
    return type == Type::eSampledImage || type == Type::eUniformTexelBuffer;
}
static_assert(
    std::ranges::count_if(kFrameBindings, [](const auto& b) { return isTexture(b.type); }) +
        std::ranges::count_if(kScreenBindings,
                              [](const auto& b) { return isTexture(b.descriptorType); }) ==
    kPassTextures);

vk::raii::DescriptorSetLayout blendSetLayout(const gpu::Device& device) {
    const std::array bindings = {
        vk::DescriptorSetLayoutBinding{0, Type::eSampledImage, 1, kScreenStages},
        vk::DescriptorSetLayoutBinding{1, Type::eSampledImage, 1, kScreenStages}};
    return gpu::makeSetLayout(device, bindings);
}

vk::raii::DescriptorSetLayout transmissionSetLayout(const gpu::Device& device) {
    const std::array bindings = {
        vk::DescriptorSetLayoutBinding{0, Type::eSampledImage, 1,
                                       Stage::eFragment | Stage::eCompute},
        vk::DescriptorSetLayoutBinding{1, Type::eSampledImage, 1, Stage::eFragment},
        vk::DescriptorSetLayoutBinding{2, Type::eCombinedImageSampler, 1,
                                       Stage::eFragment | Stage::eCompute}};
    return gpu::makeSetLayout(device, bindings);
}

// Streams: 0 positions, 1 surface vertices, 2 extended vertices, 3 instance rows.
void describeVertices(gpu::GraphicsPipelineInfo& info, bool surface, bool textured, bool extended) {
    using Rate = vk::VertexInputRate;
    using Format = vk::Format;
    info.bindings = {{0, 12, Rate::eVertex}, {3, 48, Rate::eInstance}};
    info.attributes = {{0, 0, Format::eR32G32B32Sfloat, 0},
                       {3, 3, Format::eR32G32B32A32Sfloat, 0},
                       {4, 3, Format::eR32G32B32A32Sfloat, 16},
                       {5, 3, Format::eR32G32B32A32Sfloat, 32}};
    if (surface) {
        info.bindings.push_back({1, 20, Rate::eVertex});
        info.attributes.push_back({1, 1, Format::eR32G32B32Sfloat, 0});
    }
    if (surface && textured) {
        info.attributes.push_back({2, 1, Format::eR32G32Sfloat, 12});
    }
    if (extended) {
        info.bindings.push_back({2, 40, Rate::eVertex});
        info.attributes.push_back({6, 2, Format::eR32G32Sfloat, 0});
        info.attributes.push_back({7, 2, Format::eR32G32B32A32Sfloat, 8});
        info.attributes.push_back({8, 2, Format::eR32G32B32A32Sfloat, 24});
    }
}

// One of four: with the extended streams or not, lights fetched together or not.
gpu::Spirv pick(bool extended,
                bool batched,
                gpu::Spirv plain,
                gpu::Spirv with_streams,
                gpu::Spirv together,
                gpu::Spirv both) {
    return batched ? (extended ? both : together) : (extended ? with_streams : plain);
}

gpu::Spirv layeredShader(GeometryPass pass, bool extended, bool batched) {
    using namespace shaders;
    switch (pass) {
    case GeometryPass::kWeighted:
        return pick(extended, batched, forward_weighted_layered_frag(),
                    forward_weighted_layered_extended_frag(),
                    forward_weighted_layered_batched_frag(),
                    forward_weighted_layered_batched_extended_frag());
    case GeometryPass::kPeelShade:
        return pick(extended, batched, forward_peeled_layered_frag(),
                    forward_peeled_layered_extended_frag(), forward_peeled_layered_batched_frag(),
                    forward_peeled_layered_batched_extended_frag());
    case GeometryPass::kTransmission:
        return pick(extended, batched, forward_transmission_layered_frag(),
                    forward_transmission_layered_extended_frag(),
                    forward_transmission_layered_batched_frag(),
                    forward_transmission_layered_batched_extended_frag());
    default:
        return pick(extended, batched, forward_layered_frag(), forward_layered_extended_frag(),
                    forward_layered_batched_frag(), forward_layered_batched_extended_frag());
    }
}

gpu::Spirv forwardShader(GeometryPass pass, bool extended, bool batched) {
    using namespace shaders;
    switch (pass) {
    case GeometryPass::kWeighted:
        return pick(extended, batched, forward_weighted_frag(), forward_weighted_extended_frag(),
                    forward_weighted_batched_frag(), forward_weighted_batched_extended_frag());
    case GeometryPass::kPeelShade:
        return pick(extended, batched, forward_peeled_frag(), forward_peeled_extended_frag(),
                    forward_peeled_batched_frag(), forward_peeled_batched_extended_frag());
    default:
        return pick(extended, batched, forward_frag(), forward_extended_frag(),
                    forward_batched_frag(), forward_batched_extended_frag());
    }
}

gpu::Spirv surfaceVertices(GeometryPass pass, bool textured, bool extended) {
    using namespace shaders;
    if (transmits(pass)) {
        return extended   ? surface_transmission_extended_vert()
               : textured ? surface_transmission_vert()
                          : surface_transmission_untextured_vert();
    }
    return extended   ? surface_extended_vert()
           : textured ? surface_vert()
                      : surface_untextured_vert();
}

gpu::Spirv fragmentShader(GeometryPass pass, const VariantKey& key) {
    using namespace shaders;
    const bool extended = (key.material_flags & io::kMaterialExtended) != 0;
    const bool batched = (key.light_flags & io::kLightBatched) != 0;
    switch (pass) {
    case GeometryPass::kDepth:
        return extended ? depth_masked_extended_frag() : depth_masked_frag();
    case GeometryPass::kOverdraw: // of surfaces with holes, as the next
        return extended ? overdraw_masked_extended_frag() : overdraw_masked_frag();
    case GeometryPass::kInstances:
        return extended ? instance_masked_extended_frag() : instance_masked_frag();
    case GeometryPass::kTransmissionDepth:
        return extended ? transmission_depth_masked_extended_frag()
                        : transmission_depth_masked_frag();
    case GeometryPass::kTransmittance:
        return extended ? transmittance_extended_frag() : transmittance_frag();
    case GeometryPass::kGbuffer:
    case GeometryPass::kGbufferAfterDepth:
        if (extraFormat(key.output_flags) != vk::Format::eUndefined) {
            return extended ? gbuffer_extra_extended_frag() : gbuffer_extra_frag();
        }
        return extended ? gbuffer_extended_frag() : gbuffer_frag();
    default:
        return (key.material_flags & io::kMaterialLayers) != 0
                   ? layeredShader(pass, extended, batched)
                   : forwardShader(pass, extended, batched);
    }
}

// Of a pass whose vertices are positions alone.
gpu::Spirv depthOnlyShader(GeometryPass pass) {
    switch (pass) {
    case GeometryPass::kOverdraw:
        return shaders::overdraw_frag();
    case GeometryPass::kInstances:
        return shaders::instance_frag();
    case GeometryPass::kPeelSelect:
        return shaders::peel_select_frag();
    case GeometryPass::kPeelCount:
        return shaders::peel_count_frag();
    case GeometryPass::kTransmissionDepth:
        return shaders::transmission_depth_frag();
    default:
        return {};
    }
}

std::vector<vk::Format> colorFormats(GeometryPass pass, uint32_t output_flags) {
    switch (pass) {
    case GeometryPass::kDepth:
    case GeometryPass::kPeelCount:
    case GeometryPass::kTransmissionDepth:
        return {};
    case GeometryPass::kGbuffer:
    case GeometryPass::kGbufferAfterDepth:
        if (const auto extra = extraFormat(output_flags); extra != vk::Format::eUndefined) {
            return {Pipelines::gbufferFormat(output_flags), extra};
        }
        return {Pipelines::gbufferFormat(output_flags)};
    case GeometryPass::kWeighted:
        return {Pipelines::kRadianceFormat, Pipelines::kBlendWeightFormat};
    case GeometryPass::kPeelSelect:
        return {Pipelines::kPeelKeyFormat};
    case GeometryPass::kTransmittance:
        return {Pipelines::kTransmittanceFormat};
    default:
        return {Pipelines::kRadianceFormat};
    }
}

// How a pass meets the depth and the colours that are there.
void describeTests(gpu::GraphicsPipelineInfo& info, GeometryPass pass) {
    switch (pass) {
    case GeometryPass::kGbufferAfterDepth:
    case GeometryPass::kForwardAfterDepth:
        info.depth_compare = vk::CompareOp::eEqual;
        info.depth_write = false;
        break;
    case GeometryPass::kTransparent:
    case GeometryPass::kTransparentBehind:
        info.depth_write = false;
        info.blend = gpu::Blend::kOver;
        break;
    case GeometryPass::kWeighted:
        info.depth_write = false;
        info.blend = gpu::Blend::kWeighted;
        break;
    case GeometryPass::kPeelShade:
        info.depth_compare = vk::CompareOp::eEqual;
        info.depth_write = false;
        info.blend = gpu::Blend::kUnder;
        break;
    case GeometryPass::kTransmission:
        info.depth_compare = vk::CompareOp::eEqual;
        info.depth_write = false;
        info.blend = gpu::Blend::kOver;
        break;
    case GeometryPass::kPeelCount:
        info.depth_compare = vk::CompareOp::eGreater;
        break;
    case GeometryPass::kTransmittance:
        info.depth_write = false;
        info.blend = gpu::Blend::kDim;
        break;
    case GeometryPass::kOverdraw:
        info.blend = gpu::Blend::kAdd;
        break;
    default:
        break;
    }
}

} // namespace

gpu::SpecConstants specConstants(const VariantKey& key, const gpu::DeviceTraits& device) {
    return {featuresOf(key.material_flags), key.light_flags, key.output_flags,
            std::max(1U, device.subgroup_size), texturesOf(key.material_flags)};
}

gpu::SpecConstants fragmentConstants(VariantKey key, const gpu::DeviceTraits& device) {
    key.material_flags |= device.is_cpu ? 0U : io::kMaterialGradients;
    return specConstants(key, device);
}

Pipelines::Pipelines(const gpu::Device& device, const gpu::Timeline& timeline, VariantMaker& maker)
    : device_(device), frame_layout_(frameSetLayout(device)),
      material_layout_(materialSetLayout(device)),
      screen_set_layout_(gpu::makeSetLayout(device, kScreenBindings)),
      geometry_layout_(gpu::makePipelineLayout(device, {*frame_layout_, *material_layout_})),
      screen_layout_(gpu::makePipelineLayout(device, {*frame_layout_, *screen_set_layout_})),
      blend_set_layout_(render::blendSetLayout(device)),
      told_layout_(gpu::makePipelineLayout(device,
                                           {*frame_layout_, *material_layout_, *blend_set_layout_},
                                           sizeof(io::PeelDraw),
                                           Stage::eFragment)),
      transmission_set_layout_(render::transmissionSetLayout(device)),
      transmission_layout_(gpu::makePipelineLayout(
          device, {*frame_layout_, *material_layout_, *transmission_set_layout_})),
      resolve_layout_(gpu::makePipelineLayout(device, {*blend_set_layout_})),
      over_unlit_layout_(gpu::makePipelineLayout(
          device, {*frame_layout_, *screen_set_layout_, *blend_set_layout_})),
      blend_resolve_(timeline, maker, settings::kTransparencyNames.size()),
      blend_over_unlit_(timeline, maker, 2 * settings::kToneMapNames.size()),
      geometry_(timeline, maker, kKeptGeometry) {}

vk::raii::Pipeline Pipelines::makeGeometry(GeometryPass pass, const VariantKey& key) const {
    const bool extended = (key.material_flags & io::kMaterialExtended) != 0;
    const bool surface = !depthOnly(pass) || hasHoles(key.material_flags);
    gpu::GraphicsPipelineInfo info;
    info.constants = fragmentConstants(key, device_.traits());
    info.layout = layoutOf(pass);
    info.depth_format = kDepthFormat;
    const bool textured = extended || fetchesCoordinates(key.material_flags);
    describeVertices(info, surface, textured, surface && extended);
    info.vertex = surface ? surfaceVertices(pass, textured, extended) : shaders::depth_vert();
    info.fragment = surface ? fragmentShader(pass, key) : depthOnlyShader(pass);
    info.color_formats = colorFormats(pass, key.output_flags);
    describeTests(info, pass);
    return gpu::makeGraphicsPipeline(device_, info, kGeometryNames[static_cast<size_t>(pass)]);
}

vk::Pipeline Pipelines::geometry(GeometryPass pass, const VariantKey& key) {
    return *geometry_.findOrMake(std::tuple(pass, key),
                                 [=, this] { return makeGeometry(pass, key); });
}

bool Pipelines::prepareGeometry(GeometryPass pass, const VariantKey& key) {
    return geometry_.prepare(std::tuple(pass, key), [=, this] { return makeGeometry(pass, key); });
}

vk::Pipeline Pipelines::blendResolve(settings::Transparency transparency) {
    return *blend_resolve_.findOrMake(transparency, [=, this] {
        gpu::GraphicsPipelineInfo info;
        info.vertex = shaders::fullscreen_vert();
        info.fragment = transparency == settings::Transparency::kWeighted
                            ? shaders::blend_resolve_weighted_frag()
                            : shaders::blend_resolve_peeled_frag();
        info.layout = *resolve_layout_;
        info.color_formats = {kRadianceFormat};
        info.blend = gpu::Blend::kOver;
        return gpu::makeGraphicsPipeline(device_, info, kBlendResolveName);
    });
}

vk::Pipeline Pipelines::blendOverUnlit(settings::Transparency transparency, uint32_t output_flags) {
    const bool weighted = transparency == settings::Transparency::kWeighted;
    return *blend_over_unlit_.findOrMake(std::tuple(weighted, output_flags), [=, this] {
        return gpu::makeComputePipeline(
            device_,
            weighted ? shaders::blend_over_unlit_weighted_comp() : shaders::blend_over_unlit_comp(),
            constants({0, 0, output_flags}), *over_unlit_layout_, kBlendOverUnlitName);
    });
}

std::vector<Pipelines::Made> Pipelines::made() const {
    std::vector<Made> all;
    geometry_.forEachKey([&](const auto& id) {
        all.push_back({kGeometryNames[static_cast<size_t>(std::get<0>(id))], std::get<1>(id)});
    });
    blend_resolve_.forEachKey([&](const auto& /*key*/) { all.push_back({kBlendResolveName, {}}); });
    blend_over_unlit_.forEachKey([&](const auto& id) {
        all.push_back({kBlendOverUnlitName, {0, 0, std::get<1>(id)}});
    });
    return all;
}

} // namespace froxel::render

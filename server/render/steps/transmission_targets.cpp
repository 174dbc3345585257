#include "render/steps/transmission_targets.h"

#include "gpu/pipeline.h"
#include "interface/visibility_io.h"
#include "render/pipelines/screen_groups.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace froxel::render {

namespace {

// Of a pixel, where transparency is not peeled, which has a number of its own.
constexpr uint32_t kMostLayers = 4;

using Type = vk::DescriptorType;

vk::DescriptorImageInfo viewOf(vk::ImageView view, vk::Sampler sampler = {}) {
    // A null view describes none.
    return {.sampler = sampler, .imageView = view, .imageLayout = vk::ImageLayout::eGeneral};
}

vk::WriteDescriptorSet write(const vk::raii::DescriptorSet& set,
                             uint32_t binding,
                             Type type,
                             const vk::DescriptorImageInfo& image) {
    return {.dstSet = *set,
            .dstBinding = binding,
            .descriptorCount = 1,
            .descriptorType = type,
            .pImageInfo = &image};
}

} // namespace

uint32_t mostLayers(const settings::ViewSettings& settings) {
    return settings.transparency == settings::Transparency::kPeeled ? settings.peel_layers
                                                                    : kMostLayers;
}

std::optional<StepPlan> planOfTransmission(const PlanInputs& inputs) {
    if (!inputs.facts.transmissive_visible) {
        return {};
    }
    const bool by_ids = inputs.facts.transmissive_by_ids && inputs.plan.lights_in_compute;
    const uint32_t culls = by_ids && inputs.facts.cull_meshlets ? kCullsLayers : 0U;
    return StepPlan{.way = (by_ids ? kLayersByIds : 0U) | culls,
                    .count = mostLayers(inputs.settings)};
}

VisibilityScene*
layersById(const SceneResources& scene, const StepInputs& inputs, const StepPlan& plan) {
    const Detail detail = scene.detailOf(inputs.settings.geometry_error_px);
    return (plan.way & kLayersByIds) != 0
               ? &inputs.pose.materialSet()->visibility(detail, Surfaces::kTransmissive)
               : nullptr;
}

float highestLevel(const SceneResources& scene, const StepInputs& inputs) {
    float roughness = 0; // as shaders/lib/layer_types.glsl has it
    for (const DrawGroup& group : inputs.draws.transmissive.groups) {
        const io::Material& material = scene.material_uniforms[group.material];
        // A glossiness texture can only say that a surface is rougher.
        const bool textured = (group.material_flags & io::kMaterialGlossiness) != 0;
        roughness = std::max(roughness, (textured ? 1 : material.roughness) *
                                            std::clamp(2 * material.ior - 2, 0.0F, 1.0F));
    }
    return roughness * std::log2(static_cast<float>(inputs.size.drawn.width_px));
}

TransmissionShape
transmissionShape(const SceneResources& scene, const StepInputs& inputs, const StepPlan& plan) {
    const settings::Size& drawn = inputs.size.drawn;
    const auto all_levels =
        static_cast<uint32_t>(std::bit_width(std::max(drawn.width_px, drawn.height_px)));
    return {.layer_count = std::min(plan.count, inputs.draws.transmissive.triangle_count),
            .level_count = highestLevel(scene, inputs) > 0 ? all_levels : 1,
            .by_ids = (plan.way & kLayersByIds) != 0,
            .nearest_depth = plan.blended_output_flags != 0};
}

TransmissionImages transmissionImages(const settings::Size& drawn, const TransmissionShape& shape) {
    using Usage = vk::ImageUsageFlagBits;
    const vk::Extent2D extent{drawn.width_px, drawn.height_px};
    const gpu::ImageInfo tested{.format = Pipelines::kDepthFormat,
                                .extent = extent,
                                .usage = Usage::eDepthStencilAttachment | Usage::eSampled,
                                .aspect = vk::ImageAspectFlagBits::eDepth};
    const gpu::ImageInfo stored{.format = vk::Format::eR32Sfloat,
                                .extent = extent,
                                .usage = Usage::eStorage | Usage::eSampled};
    return {.behind = {.format = Pipelines::kRadianceFormat,
                       .extent = extent,
                       .mip_count = shape.level_count,
                       .usage = Usage::eSampled | Usage::eStorage,
                       .filtered = true},
            .layer_depth = shape.by_ids ? stored : tested,
            .layer_depth_count =
                shape.by_ids ? (shape.nearest_depth ? 1U : 0U) : shape.layer_count};
}

vk::DeviceSize layerWordBytes(const settings::Size& drawn, const TransmissionShape& shape) {
    return shape.by_ids ? kWordBytes * shape.layer_count * drawn.width_px * drawn.height_px : 0;
}

uint32_t layerTileCount(const settings::Size& drawn) {
    return screenGroups(drawn.width_px) * screenGroups(drawn.height_px);
}

vk::DeviceSize layerTileBytes(const settings::Size& drawn, const TransmissionShape& shape) {
    static_assert(io::kMostPeelLayers >= settings::kPeelLayersRange.max);
    const vk::DeviceSize tiles = layerTileCount(drawn);
    return shape.by_ids ? sizeof(uint32_t) * (io::kTileHeadWords + shape.layer_count * tiles) : 0;
}

vk::Rect2D around(std::span<const vk::Rect2D> parts) {
    constexpr auto kGroup = static_cast<int32_t>(io::kScreenGroup);
    vk::Offset2D low{INT32_MAX, INT32_MAX};
    vk::Offset2D high{0, 0};
    for (const vk::Rect2D& part : parts) {
        low.x = std::min(low.x, part.offset.x / kGroup * kGroup);
        low.y = std::min(low.y, part.offset.y / kGroup * kGroup);
        high.x = std::max(high.x, part.offset.x + static_cast<int32_t>(part.extent.width));
        high.y = std::max(high.y, part.offset.y + static_cast<int32_t>(part.extent.height));
    }
    if (high.x <= low.x || high.y <= low.y) {
        return {};
    }
    return {low, {static_cast<uint32_t>(high.x - low.x), static_cast<uint32_t>(high.y - low.y)}};
}

TransmissionLayouts::TransmissionLayouts(const DeviceResources& shared)
    : sampler(shared.device.handle().createSampler(
          {.magFilter = vk::Filter::eLinear,
           .minFilter = vk::Filter::eLinear,
           .mipmapMode = vk::SamplerMipmapMode::eNearest,
           .addressModeU = vk::SamplerAddressMode::eClampToEdge,
           .addressModeV = vk::SamplerAddressMode::eClampToEdge,
           .maxLod = VK_LOD_CLAMP_NONE})),
      level_layout(gpu::makeSetLayout(
          shared.device,
          std::array{vk::DescriptorSetLayoutBinding{0, Type::eCombinedImageSampler, 1,
                                                    vk::ShaderStageFlagBits::eCompute},
                     vk::DescriptorSetLayoutBinding{1, Type::eStorageImage, 1,
                                                    vk::ShaderStageFlagBits::eCompute},
                     vk::DescriptorSetLayoutBinding{2, Type::eStorageBuffer, 1,
                                                    vk::ShaderStageFlagBits::eCompute}})) {}

TransmissionTargets::TransmissionTargets(DeviceResources& shared,
                                         const TransmissionShape& shape,
                                         std::shared_ptr<const ViewTargets> view)
    : arena(shared.device), shape_(shape), view_(std::move(view)),
      solid_depth_(*view_->solidDepth().view) {
    const TransmissionImages images = transmissionImages(view_->size.drawn, shape);
    behind = arena.makeImage(images.behind, "picture behind");
    for (uint32_t layer = 0; layer < images.layer_depth_count; ++layer) {
        layer_depths.push_back(arena.makeImage(images.layer_depth, "transmissive layer depth"));
    }
    if (shape.by_ids) {
        using Usage = vk::BufferUsageFlagBits;
        words = arena.makeBuffer(layerWordBytes(view_->size.drawn, shape),
                                 Usage::eStorageBuffer | Usage::eTransferDst,
                                 gpu::MemoryUse::kDevice, "words of transmissive layers");
        tiles =
            arena.makeBuffer(layerTileBytes(view_->size.drawn, shape),
                             Usage::eStorageBuffer | Usage::eIndirectBuffer | Usage::eTransferDst,
                             gpu::MemoryUse::kDevice, "tiles of transmissive layers");
    }
    makeViews(shared.device);
    writeSets(shared);
}

void TransmissionTargets::makeViews(const gpu::Device& device) {
    for (uint32_t level = 0; level < shape_.level_count; ++level) {
        level_views_.push_back(device.handle().createImageView(
            {.image = *behind.handle,
             .viewType = vk::ImageViewType::e2D,
             .format = behind.format,
             .subresourceRange = {vk::ImageAspectFlagBits::eColor, level, 1, 0, 1}}));
        device.setName(*level_views_.back(), "level of the picture behind");
    }
}

void TransmissionTargets::writeSets(DeviceResources& shared) {
    const auto& shared_layouts = shared.stored<TransmissionLayouts>();
    const uint32_t found_count = shape_.by_ids ? 0 : shape_.layer_count;
    const uint32_t depth_count = found_count + 1;
    const std::array sizes = {
        vk::DescriptorPoolSize{Type::eSampledImage, 2 * depth_count},
        vk::DescriptorPoolSize{Type::eCombinedImageSampler, depth_count + shape_.level_count},
        vk::DescriptorPoolSize{Type::eStorageImage, shape_.level_count},
        vk::DescriptorPoolSize{Type::eStorageBuffer, shape_.level_count}};
    pool_ = gpu::makeDescriptorPool(shared.device, sizes, depth_count + shape_.level_count);
    const auto allocate = [&](vk::DescriptorSetLayout layout, uint32_t count) {
        const std::vector layouts(count, layout);
        return shared.device.handle().allocateDescriptorSets(
            {.descriptorPool = *pool_, .descriptorSetCount = count, .pSetLayouts = layouts.data()});
    };
    depth_sets_ = allocate(shared.pipelines.transmissionSetLayout(), depth_count);
    level_sets_ = allocate(*shared_layouts.level_layout, shape_.level_count);
    for (uint32_t layer = 0; layer < depth_count; ++layer) {
        const bool draws = layer == found_count;
        const auto solid = viewOf(solid_depth_);
        const auto before =
            viewOf(layer == 0 || draws ? vk::ImageView{} : *layer_depths[layer - 1].view);
        const auto seen = viewOf(draws ? *behind.view : vk::ImageView{}, *shared_layouts.sampler);
        shared.device.handle().updateDescriptorSets(
            {write(depth_sets_[layer], 0, Type::eSampledImage, solid),
             write(depth_sets_[layer], 1, Type::eSampledImage, before),
             write(depth_sets_[layer], 2, Type::eCombinedImageSampler, seen)},
            {});
    }
    for (uint32_t level = 0; level < shape_.level_count; ++level) {
        const auto finer = viewOf(level == 0 ? vk::ImageView{} : *level_views_[level - 1],
                                  *shared_layouts.sampler);
        const auto coarser = viewOf(*level_views_[level]);
        const vk::DescriptorBufferInfo listed{.buffer = *tiles.handle, .range = VK_WHOLE_SIZE};
        shared.device.handle().updateDescriptorSets(
            {write(level_sets_[level], 0, Type::eCombinedImageSampler, finer),
             write(level_sets_[level], 1, Type::eStorageImage, coarser),
             vk::WriteDescriptorSet{.dstSet = *level_sets_[level],
                                    .dstBinding = 2,
                                    .descriptorCount = 1,
                                    .descriptorType = Type::eStorageBuffer,
                                    .pBufferInfo = &listed}},
            {});
    }
}

bool TransmissionTargets::fits(const TransmissionShape& shape, const ViewTargets& view) const {
    return shape_ == shape && view_.get() == &view && solid_depth_ == *view.solidDepth().view;
}

vk::Extent2D TransmissionTargets::levelExtent(uint32_t level) const {
    return {std::max(behind.extent.width >> level, 1U),
            std::max(behind.extent.height >> level, 1U)};
}

void TransmissionTargets::forEachImage(const Visit& visit) const {
    visit(behind, vk::ImageAspectFlagBits::eColor);
    for (const gpu::Image& depth : layer_depths) {
        visit(depth,
              shape_.by_ids ? vk::ImageAspectFlagBits::eColor : vk::ImageAspectFlagBits::eDepth);
    }
}

const TransmissionTargets& transmissionTargets(const FrameContext& frame) {
    return frame.slot.step_targets.get<TransmissionTargets>();
}

void bindTransmission(const FrameContext& frame, vk::DescriptorSet set) {
    frame.slot.cmd.bindDescriptorSets(vk::PipelineBindPoint::eGraphics,
                                      frame.scene.shared.pipelines.transmissionPipelineLayout(), 2,
                                      set, {});
}

} // namespace froxel::render

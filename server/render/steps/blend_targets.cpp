#include "render/steps/blend_targets.h"

#include "gpu/pipeline.h"

#include <algorithm>
#include <array>
#include <utility>

namespace froxel::render {

std::vector<BlendImage> blendImages(settings::Transparency transparency,
                                    const settings::Size& drawn) {
    using Usage = vk::ImageUsageFlagBits;
    const auto color = [&](const char* name, vk::Format format) {
        return BlendImage{name,
                          {.format = format,
                           .extent = {drawn.width_px, drawn.height_px},
                           .usage = Usage::eColorAttachment | Usage::eSampled}};
    };
    std::vector images = {color("blended sums", Pipelines::kRadianceFormat)};
    if (transparency == settings::Transparency::kWeighted) {
        images.push_back(color("blend weights", Pipelines::kBlendWeightFormat));
    } else if (transparency == settings::Transparency::kPeeled) {
        images.push_back({"peeled layer depth",
                          {.format = Pipelines::kDepthFormat,
                           .extent = {drawn.width_px, drawn.height_px},
                           .usage = Usage::eDepthStencilAttachment,
                           .aspect = vk::ImageAspectFlagBits::eDepth}});
        images.insert(images.end(), 2, color("peeled layer keys", Pipelines::kPeelKeyFormat));
    }
    return images;
}

BlendTargets::BlendTargets(const gpu::Device& device,
                           const Pipelines& pipelines,
                           settings::Transparency transparency,
                           std::shared_ptr<const ViewTargets> view)
    : arena(device), transparency_(transparency), view_(std::move(view)),
      solid_depth_(*view_->solidDepth().view) {
    std::vector<gpu::Image> images;
    for (const auto& [name, info] : blendImages(transparency, view_->size.drawn)) {
        images.push_back(arena.makeImage(info, name));
    }
    sums = std::move(images[0]);
    if (transparency == settings::Transparency::kWeighted) {
        weights = std::move(images[1]);
    } else if (transparency == settings::Transparency::kPeeled) {
        layer_depth = std::move(images[1]);
        layer_keys = {std::move(images[2]), std::move(images[3])};
    }
    writeSets(device, pipelines);
}

bool BlendTargets::fits(settings::Transparency transparency, const ViewTargets& view) const {
    return transparency_ == transparency && view_.get() == &view &&
           solid_depth_ == *view.solidDepth().view;
}

void BlendTargets::writeSets(const gpu::Device& device, const Pipelines& pipelines) {
    constexpr uint32_t kSets = 3;
    const vk::DescriptorPoolSize size{vk::DescriptorType::eSampledImage, 2 * kSets};
    pool_ = gpu::makeDescriptorPool(device, std::array{size}, kSets);
    const std::vector layouts(kSets, pipelines.blendSetLayout());
    sets_ = device.handle().allocateDescriptorSets(
        {.descriptorPool = *pool_, .descriptorSetCount = kSets, .pSetLayouts = layouts.data()});
    const auto write = [&](const vk::raii::DescriptorSet& set, vk::ImageView a, vk::ImageView b) {
        // A null handle describes none.
        const std::array images = {
            vk::DescriptorImageInfo{.imageView = a, .imageLayout = vk::ImageLayout::eGeneral},
            vk::DescriptorImageInfo{.imageView = b, .imageLayout = vk::ImageLayout::eGeneral}};
        device.handle().updateDescriptorSets(
            vk::WriteDescriptorSet{.dstSet = *set,
                                   .dstBinding = 0,
                                   .descriptorCount = static_cast<uint32_t>(images.size()),
                                   .descriptorType = vk::DescriptorType::eSampledImage,
                                   .pImageInfo = images.data()},
            {});
    };
    for (size_t parity = 0; parity < layer_keys.size(); ++parity) {
        write(sets_[parity], solid_depth_, *layer_keys[parity].view);
    }
    write(sets_[2], *sums.view, *weights.view);
}

void BlendTargets::forEachImage(const Visit& visit) const {
    const auto visitColor = [&visit](const gpu::Image& image) {
        visit(image, vk::ImageAspectFlagBits::eColor); // of an absent one: nothing
    };
    visitColor(sums);
    visitColor(weights);
    visit(layer_depth, vk::ImageAspectFlagBits::eDepth);
    std::ranges::for_each(layer_keys, visitColor);
}

} // namespace froxel::render

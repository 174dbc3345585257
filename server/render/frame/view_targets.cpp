#include "render/frame/view_targets.h"

#include "render/pipelines/gbuffer_layout.h"
#include "render/pipelines/pipelines.h"
#include "render/scene/visibility_pipelines.h"

#include <algorithm>

namespace froxel::render {

std::vector<TargetImage> targetImages(const settings::Size& drawn, const TargetNeeds& needs) {
    using Usage = vk::ImageUsageFlagBits;
    const vk::Extent2D extent{drawn.width_px, drawn.height_px};
    std::vector<TargetImage> images;
    const auto add = [&](gpu::Image ViewTargets::*image, const char* name, vk::Format format,
                         vk::ImageUsageFlags usage,
                         vk::ImageAspectFlags aspect = vk::ImageAspectFlagBits::eColor) {
        images.push_back(
            {image, name, {.format = format, .extent = extent, .usage = usage, .aspect = aspect}});
    };
    add(&ViewTargets::depth, "depth", Pipelines::kDepthFormat,
        Usage::eDepthStencilAttachment | Usage::eSampled |
            (needs.visibility ? Usage::eTransferSrc : Usage{}) |
            (needs.compute_raster ? Usage::eTransferDst : Usage{}),
        vk::ImageAspectFlagBits::eDepth);
    if (needs.gbuffer) {
        add(&ViewTargets::gbuffer, "gbuffer", Pipelines::gbufferFormat(needs.gbuffer_flags),
            Usage::eColorAttachment | Usage::eSampled |
                (needs.visibility ? Usage::eStorage : Usage{}));
        if (const auto format = extraFormat(needs.gbuffer_flags);
            format != vk::Format::eUndefined) {
            add(&ViewTargets::gbuffer_extra, "gbuffer extra", format,
                Usage::eColorAttachment | Usage::eSampled);
        }
    }
    if (needs.visibility) {
        add(&ViewTargets::ids, "visible ids", VisibilityPipelines::kIdFormat,
            Usage::eColorAttachment | Usage::eSampled | Usage::eStorage | Usage::eTransferSrc);
    }
    if (needs.compute_raster) {
        add(&ViewTargets::compute_depth, "depth from compute", vk::Format::eR32Sfloat,
            Usage::eSampled | Usage::eStorage | Usage::eTransferSrc);
    }
    if (needs.radiance) {
        add(&ViewTargets::radiance, "radiance", Pipelines::kRadianceFormat,
            Usage::eColorAttachment | Usage::eStorage | Usage::eTransferSrc |
                (needs.sampled_radiance ? Usage::eSampled : Usage{}));
    }
    return images;
}

ViewTargets::ViewTargets(const gpu::Device& device,
                         const settings::Size& drawn,
                         const settings::Size& shown_in,
                         const TargetNeeds& needs_in)
    : size(drawn), shown(shown_in), needs(needs_in), arena(device) {
    using BufferUsage = vk::BufferUsageFlagBits;
    for (const auto& [image, name, info] : targetImages(size, needs)) {
        this->*image = arena.makeImage(info, name);
    }
    if (needs.compute_raster) {
        words = arena.makeBuffer(kWordBytes * size.width_px * size.height_px,
                                 BufferUsage::eStorageBuffer | BufferUsage::eTransferSrc |
                                     BufferUsage::eTransferDst,
                                 gpu::MemoryUse::kDevice, "depth and id words");
    }
    const auto packed_bytes = packedBytes(shown);
    if (needs.display) {
        display = arena.makeBuffer(packed_bytes,
                                   BufferUsage::eStorageBuffer | BufferUsage::eUniformTexelBuffer,
                                   gpu::MemoryUse::kDevice, "display");
    }
    if (needs.device_pixels) {
        pixels =
            arena.makeBuffer(packed_bytes, BufferUsage::eStorageBuffer | BufferUsage::eTransferSrc,
                             gpu::MemoryUse::kDevice, "pixels");
    }
}

TargetNeeds targetNeeds(const FramePlan& plan,
                        const gpu::Device& device,
                        const settings::Size& drawn,
                        const settings::Size& shown,
                        const ViewTargets* kept) {
    TargetNeeds needs{.gbuffer = plan.gbuffer,
                      .gbuffer_flags = plan.gbuffer_output_flags,
                      .radiance = plan.radiance,
                      .visibility = plan.visibility,
                      .compute_raster = plan.compute_raster,
                      .sampled_radiance = std::ranges::any_of(
                          plan.effects, [](const auto& it) { return it.plan.samples_radiance; }),
                      .display = plan.hasEffect(EffectPlace::kPixels),
                      .device_pixels = !device.traits().is_cpu};
    if (kept == nullptr || kept->size != drawn || kept->shown != shown) {
        return needs;
    }
    const TargetNeeds& had = kept->needs;
    if (had.covers(needs)) {
        return had;
    }
    if (!needs.gbuffer && had.gbuffer) {
        needs.gbuffer = true;
        needs.gbuffer_flags = had.gbuffer_flags;
    }
    needs.radiance |= had.radiance;
    needs.visibility |= had.visibility;
    needs.compute_raster |= had.compute_raster;
    return needs;
}

} // namespace froxel::render

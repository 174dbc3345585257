#include "render/frame/view_targets.h"

#include "render/device/visibility_pipelines.h"
#include "render/pipelines/gbuffer_layout.h"
#include "render/pipelines/pipelines.h"

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
                         const FrameSize& size_in,
                         const TargetNeeds& needs_in)
    : size(size_in), needs(needs_in), arena(device) {
    using BufferUsage = vk::BufferUsageFlagBits;
    for (const auto& [image, name, info] : targetImages(size.drawn, needs)) {
        this->*image = arena.makeImage(info, name);
    }
    if (needs.compute_raster) {
        words = arena.makeBuffer(kWordBytes * size.drawn.width_px * size.drawn.height_px,
                                 BufferUsage::eStorageBuffer | BufferUsage::eTransferSrc |
                                     BufferUsage::eTransferDst,
                                 gpu::MemoryUse::kDevice, "depth and id words");
    }
    const auto packed_bytes = packedBytes(size.shown);
    for (uint32_t i = 0; i < needs.display_count; ++i) {
        display[i] = arena.makeBuffer(
            packed_bytes, BufferUsage::eStorageBuffer | BufferUsage::eUniformTexelBuffer,
            gpu::MemoryUse::kDevice, "display");
    }
    if (needs.device_pixels) {
        pixels =
            arena.makeBuffer(packed_bytes, BufferUsage::eStorageBuffer | BufferUsage::eTransferSrc,
                             gpu::MemoryUse::kDevice, "pixels");
    }
}

namespace {

void addUse(const Use& use, TargetNeeds& needs) {
    switch (use.what) {
    case Resource::kGbuffer:
        needs.gbuffer = true;
        break;
    case Resource::kRadiance:
        needs.radiance = true;
        needs.sampled_radiance |=
            static_cast<bool>(use.access & vk::AccessFlagBits2::eShaderSampledRead);
        break;
    case Resource::kIds:
        needs.visibility = true;
        break;
    case Resource::kWords:
        needs.compute_raster = true;
        break;
    case Resource::kDisplay:
        needs.display_count = std::max(needs.display_count, 1U);
        break;
    case Resource::kDisplay2:
        needs.display_count = 2;
        break;
    case Resource::kPixels:
        needs.device_pixels |= !writes(use); // a step reads them
        break;
    default: // a step's own, or always there
        break;
    }
}

} // namespace

TargetNeeds targetNeeds(const FramePlan& plan, const FrameSize& size, const ViewTargets* kept) {
    TargetNeeds needs;
    for (const PlannedStep& step : plan.steps) {
        for (const Use& use : step.uses) {
            addUse(use, needs);
        }
    }
    needs.gbuffer_flags = needs.gbuffer ? plan.gbuffer_output_flags : 0;
    if (kept == nullptr || kept->size != size) {
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

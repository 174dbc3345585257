#include "render/view_targets.h"

#include "render/gbuffer_layout.h"
#include "render/pipelines.h"
#include "render/visibility_pipelines.h"

namespace froxel::render {

ViewTargets::ViewTargets(const gpu::Device& device,
                         const view::Size& drawn,
                         const view::Size& shown_in,
                         const TargetNeeds& needs_in)
    : size(drawn), shown(shown_in), needs(needs_in), arena(device) {
    using Usage = vk::ImageUsageFlagBits;
    const vk::Extent2D extent{size.width_px, size.height_px};
    depth = arena.makeImage({.format = Pipelines::kDepthFormat,
                             .extent = extent,
                             .usage = Usage::eDepthStencilAttachment | Usage::eSampled |
                                      (needs.visibility ? Usage::eTransferSrc : Usage{}) |
                                      (needs.compute_raster ? Usage::eTransferDst : Usage{}),
                             .aspect = vk::ImageAspectFlagBits::eDepth},
                            "depth");
    if (needs.gbuffer) {
        gbuffer = arena.makeImage({.format = Pipelines::gbufferFormat(needs.gbuffer_flags),
                                   .extent = extent,
                                   .usage = Usage::eColorAttachment | Usage::eSampled |
                                            (needs.visibility ? Usage::eStorage : Usage{})},
                                  "gbuffer");
        if (const auto format = extraFormat(needs.gbuffer_flags);
            format != vk::Format::eUndefined) {
            gbuffer_extra = arena.makeImage({.format = format,
                                             .extent = extent,
                                             .usage = Usage::eColorAttachment | Usage::eSampled},
                                            "gbuffer extra");
        }
    }
    if (needs.visibility) {
        ids = arena.makeImage({.format = VisibilityPipelines::kIdFormat,
                               .extent = extent,
                               .usage = Usage::eColorAttachment | Usage::eSampled |
                                        Usage::eStorage | Usage::eTransferSrc},
                              "visible ids");
    }
    if (needs.compute_raster) {
        using BufferUsage = vk::BufferUsageFlagBits;
        words = arena.makeBuffer(vk::DeviceSize{8} * size.width_px * size.height_px,
                                 BufferUsage::eStorageBuffer | BufferUsage::eTransferSrc |
                                     BufferUsage::eTransferDst,
                                 gpu::MemoryUse::kDevice, "depth and id words");
        compute_depth =
            arena.makeImage({.format = vk::Format::eR32Sfloat,
                             .extent = extent,
                             .usage = Usage::eSampled | Usage::eStorage | Usage::eTransferSrc},
                            "depth from compute");
    }
    if (needs.radiance) {
        radiance = arena.makeImage({.format = Pipelines::kRadianceFormat,
                                    .extent = extent,
                                    .usage = Usage::eColorAttachment | Usage::eStorage |
                                             Usage::eTransferSrc |
                                             (needs.sampled_radiance ? Usage::eSampled : Usage{})},
                                   "radiance");
    }
    const auto packed_bytes = vk::DeviceSize{4} * shown.width_px * shown.height_px;
    if (needs.display) {
        display = arena.makeBuffer(packed_bytes,
                                   vk::BufferUsageFlagBits::eStorageBuffer |
                                       vk::BufferUsageFlagBits::eUniformTexelBuffer,
                                   gpu::MemoryUse::kDevice, "display");
    }
    if (needs.device_pixels) {
        pixels = arena.makeBuffer(packed_bytes,
                                  vk::BufferUsageFlagBits::eStorageBuffer |
                                      vk::BufferUsageFlagBits::eTransferSrc,
                                  gpu::MemoryUse::kDevice, "pixels");
    }
}

} // namespace froxel::render

// The images and buffers that one viewer's frames are drawn into, at one size.
#pragma once

#include "core/depth_mesh.h"
#include "gpu/command_context.h"
#include "gpu/memory.h"
#include "interface/frame_io.h"
#include "render/frame/frame_inputs.h"
#include "render/frame/frame_plan.h"
#include "render/frame/jpeg_file.h"
#include "render/frame/planes.h"
#include "settings/settings.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <vector>

namespace froxel::render {

// Which targets exist; a frame may use targets that have more than it needs.
struct TargetNeeds {
    bool gbuffer = false;
    uint32_t gbuffer_flags = 0; // FramePlan::gbuffer_output_flags: its formats
    bool radiance = false;
    bool visibility = false;
    bool compute_raster = false;   // what compute rasters into
    bool sampled_radiance = false; // passes look at a pixel's neighbours
    uint32_t display_count = 0;    // of pictures before filters over them
    bool device_pixels = false;    // the host does not read packed pixels where they are written

    [[nodiscard]] bool covers(const TargetNeeds& other) const {
        const bool same_gbuffer = gbuffer && gbuffer_flags == other.gbuffer_flags;
        return (same_gbuffer || !other.gbuffer) && (radiance || !other.radiance) &&
               (visibility || !other.visibility) && (compute_raster || !other.compute_raster) &&
               (sampled_radiance || !other.sampled_radiance) &&
               display_count == other.display_count && device_pixels == other.device_pixels;
    }
    bool operator==(const TargetNeeds&) const = default;
};

// One of the pictures below.
struct ViewTargets;
struct TargetImage {
    gpu::Image ViewTargets::*image;
    const char* name;
    gpu::ImageInfo info;
};
// Those that frames drawn at this size need.
[[nodiscard]] std::vector<TargetImage> targetImages(const settings::Size& drawn,
                                                    const TargetNeeds& needs);

// Of ViewTargets::words, a pixel.
inline constexpr vk::DeviceSize kWordBytes = 8;

[[nodiscard]] inline vk::DeviceSize packedBytes(const settings::Size& shown) {
    return vk::DeviceSize{4} * shown.width_px * shown.height_px;
}

[[nodiscard]] inline vk::DeviceSize outputBytes(Output output, const FrameSize& size) {
    const vk::DeviceSize samples =
        output == Output::kDepthMesh
            ? DepthMeshSize(size.shown.width_px, size.shown.height_px).vertexCount()
            : vk::DeviceSize{size.drawn.width_px} * size.drawn.height_px;
    return samples * kOutputRows[static_cast<size_t>(output)].floats * sizeof(float);
}

// What of a frame comes to the host.
struct ReadbackBytes {
    vk::DeviceSize picture = 0;                         // packed pixels, planes or a file of them
    std::array<vk::DeviceSize, kOutputCount> outputs{}; // 0: nobody asked for it
    bool operator==(const ReadbackBytes&) const = default;
};
// Views go to and fro: room for planes or a file is room for pixels.
[[nodiscard]] inline ReadbackBytes readbackBytes(const FrameSize& size, const FrameInputs& inputs) {
    ReadbackBytes bytes{packedBytes(size.shown)};
    if (inputs.form.jpeg) {
        bytes.picture =
            std::max(bytes.picture, JpegSizes(size.shown, *inputs.form.jpeg).file_bytes);
    } else if (inputs.form.plane_sampling > 0) {
        bytes.picture =
            std::max(bytes.picture, PlaneSizes(size.shown, inputs.form.plane_sampling).bytes());
    }
    for (size_t i = 0; i < kOutputCount; ++i) {
        bytes.outputs[i] = inputs.outputs.has(static_cast<Output>(i))
                               ? outputBytes(static_cast<Output>(i), size)
                               : 0;
    }
    return bytes;
}

// What depth, ids and G-buffer were drawn from. They are functions of it alone: equal ones need no
// drawing.
struct SurfacesDrawn {
    io::FrameCamera camera;
    uint64_t draw_list = 0; // the view's, which counts those that it makes
    FramePlan plan;         // all of it, so that nothing is forgotten

    bool operator==(const SurfacesDrawn& other) const {
        return std::memcmp(&camera, &other.camera, sizeof(camera)) == 0 &&
               draw_list == other.draw_list && plan == other.plan;
    }
};

struct ViewTargets {
    // All images end in the GENERAL layout, where they stay. Throws vk::OutOfDeviceMemoryError.
    ViewTargets(const gpu::Device& device, const FrameSize& size, const TargetNeeds& needs);

    FrameSize size;
    TargetNeeds needs;
    gpu::MemoryArena arena;
    gpu::Image depth;
    gpu::Image gbuffer;       // null handle: not needed
    gpu::Image gbuffer_extra; // null handle: the layout has no second target
    gpu::Image ids;           // of visible triangles; null handle: not needed
    gpu::Buffer words;        // depth and id, 64 bits a pixel; null handle: not needed
    gpu::Image compute_depth; // as depth, where compute rasters; null handle: not needed
    gpu::Image radiance;      // null handle: not needed
    // Packed pixels that filters read, in turn; null handles: not needed.
    std::array<gpu::Buffer, 2> display;
    gpu::Buffer pixels;                    // null handle: not needed
    bool fresh = true;                     // the images still await their first transition
    bool rastered_in_compute = false;      // solid surfaces of the frame last submitted
    std::optional<SurfacesDrawn> surfaces; // that they hold once what is submitted has run

    [[nodiscard]] bool fits(const FrameSize& wanted_size, const TargetNeeds& wanted) const {
        return size == wanted_size && needs == wanted;
    }
    // Of that frame's solid surfaces.
    [[nodiscard]] const gpu::Image& solidDepth() const {
        return rastered_in_compute ? compute_depth : depth;
    }
};

// What a frame needs, and what targets of the same size (null: none) had besides: settings may go
// to and fro.
[[nodiscard]] TargetNeeds
targetNeeds(const FramePlan& plan, const FrameSize& size, const ViewTargets* kept);

} // namespace froxel::render

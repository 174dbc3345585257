#include "render/view/jpeg_trial.h"

#include "gpu/timestamps.h"
#include "render/pipelines/host_copies.h"
#include "render/steps/jpeg_passes.h"

#include <algorithm>
#include <cstring>

namespace froxel::render {

Result<JpegTrial> tryJpeg(RenderDevice& on,
                          const PixelView& pixels,
                          const JpegFormat& format,
                          const JpegTrialOptions& options) {
    DeviceResources& shared = on.resources();
    const gpu::Device& device = shared.device;
    if (auto why = jpegUnusable(device); !why.empty()) {
        return Error{ErrorCode::kUnsupported, why};
    }
    JpegSizes sizes({pixels.width_px, pixels.height_px}, format);
    sizes.picture.scan_bytes = options.scan_bytes.value_or(sizes.picture.scan_bytes);
    gpu::MemoryArena arena(device);
    const auto make = [&](vk::DeviceSize bytes, gpu::MemoryUse use) {
        return arena.makeBuffer(bytes, vk::BufferUsageFlagBits::eStorageBuffer, use, "jpeg trial");
    };
    const size_t pixel_bytes = pixels.stride_bytes * pixels.height_px;
    const auto picture = make(pixel_bytes, gpu::MemoryUse::kUpload);
    std::memcpy(picture.mapped, pixels.data, pixel_bytes);
    const auto tables = jpegTables(format);
    const auto upload = make(sizeof(tables), gpu::MemoryUse::kUpload);
    std::memcpy(upload.mapped, tables.data(), sizeof(tables));
    const auto file = make(sizes.file_bytes, gpu::MemoryUse::kReadback);
    writeJpegHeader(format, sizes, file.mapped);

    auto& pipelines = shared.stored<JpegPipelines>();
    JpegScratch scratch(device, sizes);
    JpegSet set(device, pipelines.setLayout());
    set.write(picture, *upload.handle, 0, scratch, file);
    gpu::Timestamps timestamps(device);
    JpegTrial trial;
    for (uint32_t i = 0; i < options.times; ++i) {
        timestamps.reset();
        shared.timeline.runNow([&](const vk::raii::CommandBuffer& cmd) {
            recordJpeg(cmd, timestamps, pipelines, format, sizes, set);
            recordHostRead(cmd);
        });
        FrameStats stats;
        timestamps.read(stats, false);
        const Seconds took = Microseconds(stats.gpu_us.value_or(0));
        trial.time = i == 0 ? took : std::min(trial.time, took);
    }
    const auto made = jpegFile(sizes, file.mapped);
    trial.file.assign(made.begin(), made.end());
    return trial;
}

} // namespace froxel::render

#include "render/view/memory_need.h"

#include "render/view/renderer.h"

namespace froxel::render {

namespace {

constexpr const char* kReadback = "readback"; // that of an output begins with its name
constexpr const char* kUpload = "frame upload";
constexpr const char* kHost = "host";
// Counters that come back, of each slot.
constexpr uint64_t kSlotBytes = 16 << 10U;

} // namespace

FrameMemory frameMemory(const HostWork& host_work,
                        const FrameInputs& inputs,
                        const FrameSize& size,
                        const TargetNeeds& targets,
                        std::span<const ActiveStep> steps) {
    return {.size = size,
            .targets = targets,
            .readback = readbackBytes(size, inputs),
            .lists = host_work.lightWork().capacity(),
            .host_bytes = host_work.hostBytes() + inputs.beside_bytes,
            .steps = steps};
}

std::vector<MemoryUse> memoryNeed(const FrameMemory& frame, const ImageBytes& image_bytes) {
    NeedList need(image_bytes);
    const uint64_t drawn_px = uint64_t{frame.size.drawn.width_px} * frame.size.drawn.height_px;
    const uint64_t packed_bytes = packedBytes(frame.size.shown);
    for (const auto& target : targetImages(frame.size.drawn, frame.targets)) {
        need.image(target.name, target.info);
    }
    need.buffer("depth and id words", frame.targets.compute_raster ? kWordBytes * drawn_px : 0);
    need.buffer("display", frame.targets.display_count * packed_bytes);
    need.buffer("pixels", frame.targets.device_pixels ? packed_bytes : 0);
    for (const ActiveStep& active : frame.steps) {
        active.step->addMemory(need);
    }
    need.buffer(kReadback, frame.readback.picture * ViewRenderer::kReadbackSlots);
    for (size_t i = 0; i < kOutputCount; ++i) {
        need.buffer(std::string(kOutputRows[i].name) + " " + kReadback,
                    frame.readback.outputs[i] * ViewRenderer::kReadbackSlots);
    }
    need.buffer(kUpload, frame.upload_bytes);
    if (frame.lists.clusters > 0) {
        for (const auto& part : listParts(frame.lists)) {
            need.buffer(part.name, part.bytes);
        }
        need.buffer("light list counters", kListReadbackBytes * ViewRenderer::kReadbackSlots);
    }
    need.buffer("counters", kSlotBytes * ViewRenderer::kReadbackSlots);
    need.buffer(kHost, frame.host_bytes);
    return std::move(need.uses);
}

MemoryTaken totalOf(const std::vector<MemoryUse>& uses, bool device_is_cpu) {
    MemoryTaken total;
    for (const auto& use : uses) {
        const bool of_host =
            use.purpose.ends_with(kReadback) || use.purpose == kUpload || use.purpose == kHost;
        (of_host && !device_is_cpu ? total.host_bytes : total.device_bytes) += use.bytes;
    }
    return total;
}

void letGo(const std::vector<std::unique_ptr<FrameSlot>>& slots,
           const FrameSlot& next,
           FrameMemory& frame) {
    const vk::DeviceSize upload_bytes = next.upload.addedBytes();
    frame.upload_bytes = 0;
    for (const auto& slot : slots) {
        if (!slot->in_flight) {
            slot->letGo(frame.readback, upload_bytes);
        }
        frame.upload_bytes += slot->upload.sizeFor(upload_bytes);
    }
}

Result<void> take(MemoryShare& share,
                  const FrameMemory& frame,
                  const gpu::Device& device,
                  const std::string& picture) {
    const auto need = memoryNeed(
        frame, [&](const gpu::ImageInfo& info) { return gpu::imageBytes(device, info); });
    return share.take(totalOf(need, device.traits().is_cpu), picture);
}

} // namespace froxel::render

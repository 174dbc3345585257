// One frame in flight: its command buffer, the data that the host made for it, and where its
// pixels arrive.
#pragma once

#include "gpu/command_context.h"
#include "gpu/memory.h"
#include "gpu/timestamps.h"
#include "render/device/device_resources.h"
#include "render/frame/frame_blocks.h"
#include "render/frame/frame_inputs.h"
#include "render/frame/frame_pieces.h"
#include "render/frame/host_copy.h"
#include "render/frame/step.h"
#include "render/frame/step_targets.h"
#include "render/frame/view_targets.h"
#include "render/lists/gpu_light_lists.h"
#include "render/pipelines/pipelines.h"
#include "render/pipelines/typed_store.h"
#include "render/scene/material_set.h"

#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <span>
#include <vector>

namespace froxel::render {

// Host-made data of one frame, placed in one buffer that the device reads; in the frame's uniforms
// it may change the exposure.
class FrameUpload {
  public:
    explicit FrameUpload(const gpu::Device& device);

    // Remembers the bytes, which must stay alive until commit(); returns their offset.
    template <class T>
    vk::DeviceSize add(std::span<const T> data) {
        return addBytes(std::as_bytes(data));
    }
    // What the buffer takes once `bytes` are committed: as it is, or a new one's.
    [[nodiscard]] vk::DeviceSize sizeFor(vk::DeviceSize bytes) const;
    // Frees a buffer that is too large for `bytes`; the slot must not be in flight.
    void trim(vk::DeviceSize bytes);
    [[nodiscard]] vk::DeviceSize addedBytes() const { return used_bytes_; }
    // Copies everything, into another buffer where it must; the slot must not be in flight.
    void commit();
    // Forgets what was added.
    void clear();
    [[nodiscard]] vk::Buffer buffer() const { return *buffer_.handle; }
    // Its bytes, once committed.
    [[nodiscard]] const std::byte* mapped() const { return buffer_.mapped; }

  private:
    vk::DeviceSize addBytes(std::span<const std::byte> bytes);

    struct Piece {
        vk::DeviceSize offset;
        std::span<const std::byte> bytes;
    };
    const gpu::Device& device_;
    vk::DeviceSize alignment_;
    std::unique_ptr<gpu::MemoryArena> arena_;
    gpu::Buffer buffer_;
    vk::DeviceSize used_bytes_ = 0;
    std::vector<Piece> pieces_;
};

// A picture on the host; outlives its view while a lease holds it.
struct Readback {
    Readback(const gpu::Device& device, const ReadbackBytes& bytes);

    const ReadbackBytes bytes;
    gpu::MemoryArena arena;
    gpu::Buffer buffer;                            // packed pixels, planes or a file of them
    std::array<gpu::Buffer, kOutputCount> outputs; // null handle: it is not asked for
    std::atomic<bool> leased{false};

    [[nodiscard]] const gpu::Buffer& output(Output which) const {
        return outputs[static_cast<size_t>(which)];
    }
};

// Offsets into the slot's upload buffer.
struct UploadOffsets {
    vk::DeviceSize rows = 0;
    vk::DeviceSize commands = 0;
    // Where ids are drawn: io::InstanceView of each instance, and in which order meshlets are
    // drawn.
    vk::DeviceSize instances = 0;
    vk::DeviceSize meshlet_order = 0;
};

struct FrameSlot {
    explicit FrameSlot(DeviceResources& shared);

    // Whether the frame last recorded has pieces that are still to be submitted.
    [[nodiscard]] bool unfinished() const {
        return in_flight && !given_up && done_values.size() < pieces.count();
    }
    // Whether a new frame may use the slot.
    [[nodiscard]] bool free() const { return !in_flight && (!readback || !readback->leased); }
    // All that will run of the frame last recorded has run.
    void end() {
        in_flight = false;
        uses.end();
    }
    // Throws vk::OutOfDeviceMemoryError.
    void makeReadback(const gpu::Device& device, const ReadbackBytes& bytes);
    // Not in flight: keeps nothing that the view's next frame, with so many bytes of pixels and of
    // upload, has no use for.
    void letGo(const ReadbackBytes& readback_bytes, vk::DeviceSize upload_bytes);

    vk::raii::CommandBuffer cmd; // of the piece that is recorded
    FramePieces pieces;
    HostCopy host_copy; // after them
    gpu::Timestamps timestamps;
    FrameUpload upload;
    std::shared_ptr<ViewTargets> targets;
    UploadOffsets offsets;
    TypedStore stored; // objects of steps that belong to the slot
    HeldTargets step_targets;
    std::vector<ActiveStep> steps; // of the frame last recorded
    std::shared_ptr<Readback> readback;
    vk::raii::DescriptorPool pool;
    vk::raii::DescriptorSet frame_set{nullptr};
    vk::raii::DescriptorSet screen_set{nullptr};
    std::vector<vk::raii::BufferView> texel_views; // of the frame set's texel buffers
    std::shared_ptr<MaterialSet> material_set;     // of the frame last recorded
    VisibilityScene* visibility = nullptr;         // of that; null: none was drawn by ids
    std::unique_ptr<AssignSlot> assignment;        // null: no frame asked for it yet
    bool device_lists = false; // the frame last recorded had its lists made on the device
    bool stale = false;        // an older frame was drawn again after this one
    FrameInputs inputs;        // of that frame, to draw it again
    bool in_flight = false;
    std::vector<uint64_t> done_values; // of the pieces submitted
    uint32_t waited_count = 0;         // of these
    bool given_up = false;             // the others will not be submitted
    VariantUses uses;                  // of the frame last recorded
    FrameStats stats;
    std::chrono::steady_clock::time_point submitted;
};

// Where the slot's finished pixels are read from or copied from.
[[nodiscard]] const gpu::Buffer& pixelsOf(const FrameSlot& slot);

// Packed pixels on their way to these: kDisplay, kDisplay2 or kPixels.
[[nodiscard]] const gpu::Buffer& packedPixels(const FrameSlot& slot, Resource what);

// Describes the blocks to all shaders of the frame; null buffers are the slot's upload, which was
// committed. Throws vk::SystemError.
void writeFrameSet(const gpu::Device& device, FrameSlot& slot, const FrameBlocks& blocks);

// Describes the slot's targets and where packed pixels go to the screen passes; the slot is not in
// flight.
void writeScreenSet(const gpu::Device& device, FrameSlot& slot, const gpu::Buffer& packed);

} // namespace froxel::render

// What a view's memory comes to with a frame, by purpose; of device memory the purposes are those
// of the ledger. Pure, but for what the device says of its images.
#pragma once

#include "core/frame_stats.h"
#include "render/frame/need_list.h"
#include "render/frame/view_targets.h"
#include "render/view/host_work.h"
#include "settings/settings.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace froxel::render {

struct FrameMemory {
    FrameSize size;
    TargetNeeds targets;
    ReadbackBytes readback;    // of a slot
    uint64_t upload_bytes = 0; // of all slots together
    ListCapacity lists;        // on the device
    uint64_t host_bytes = 0;   // kept by the host, encoders with it
    std::span<const ActiveStep> steps = {};
};

// Of a frame that was built and gathered; what slots hold is not yet in it.
[[nodiscard]] FrameMemory frameMemory(const HostWork& host_work,
                                      const FrameInputs& inputs,
                                      const FrameSize& size,
                                      const TargetNeeds& targets,
                                      std::span<const ActiveStep> steps);

// Steady state: every readback slot has been used. Old targets that a frame in flight still draws
// into come on top until it is done, which is never on a CPU device.
[[nodiscard]] std::vector<MemoryUse> memoryNeed(const FrameMemory& frame,
                                                const ImageBytes& image_bytes);

// Where it is: what the host reads, writes and keeps is the host's, but on a CPU device.
[[nodiscard]] MemoryTaken totalOf(const std::vector<MemoryUse>& uses, bool device_is_cpu);

// Slots that are not in flight keep nothing that the frame has no use for; `next` is to draw it,
// and has gathered it. Notes what uploads come to.
void letGo(const std::vector<std::unique_ptr<FrameSlot>>& slots,
           const FrameSlot& next,
           FrameMemory& frame);

// Asks for all of it. Errors: kCapacity.
[[nodiscard]] Result<void> take(MemoryShare& share,
                                const FrameMemory& frame,
                                const gpu::Device& device,
                                const std::string& picture);

} // namespace froxel::render

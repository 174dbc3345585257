// A frame's last step where pixels are copied to the host: on a queue of its own, beside what is
// drawn next, where the device has one.
#pragma once

#include "core/error.h"
#include "gpu/command_context.h"
#include "gpu/memory.h"

#include <cstdint>
#include <optional>

namespace froxel::render {

// One a frame slot. Its frame was submitted before it is, and targets that it reads are written by
// the view's next frame, which waits for submit()'s moment.
class HostCopy {
  public:
    // `copies`: null where the device has no queue for them.
    explicit HostCopy(gpu::Timeline* copies);

    // Whether copies are to be recorded here rather than among the frame's commands.
    [[nodiscard]] bool isBeside() const { return copies_ != nullptr; }
    // For a new frame.
    void clear();
    // All of `from`, on isBeside(). Once a frame.
    void record(const gpu::Buffer& from, const gpu::Buffer& to);
    [[nodiscard]] bool recorded() const { return recorded_; }
    // Once the frame's last piece was submitted, as `frame`. Throws vk::DeviceLostError.
    [[nodiscard]] gpu::TimelineMoment submit(const gpu::TimelineMoment& frame);
    // Until the host may read what was submitted, if anything was. Errors: as Timeline::wait().
    [[nodiscard]] Result<void> wait() const;

  private:
    gpu::Timeline* copies_;
    std::optional<vk::raii::CommandBuffer> cmd_;
    bool recorded_ = false;
    uint64_t submitted_ = 0; // as a moment of copies_; 0: not
};

} // namespace froxel::render

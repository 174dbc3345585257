// Recording and submitting on the device's one queue, ordered by one timeline semaphore.
#pragma once

#include "core/error.h"
#include "gpu/device.h"

#include <cstdint>
#include <functional>

namespace froxel::gpu {

// One thread. Every submission gets the next value of the timeline.
class Timeline {
  public:
    explicit Timeline(const Device& device);

    // Throws vk::DeviceLostError.
    uint64_t submit(const vk::raii::CommandBuffer& cmd);
    // Waits until `value` is reached. Errors: kDevice when the device is lost or does not answer.
    [[nodiscard]] Result<void> wait(uint64_t value) const;
    // What the next submission will get, and up to where all is finished.
    [[nodiscard]] uint64_t next() const { return last_ + 1; }
    [[nodiscard]] uint64_t completed() const;

    // Records, submits and waits: for loading, not for frames. Throws vk::SystemError.
    void runNow(const std::function<void(const vk::raii::CommandBuffer&)>& record);

    // A primary command buffer that can be reset and recorded again.
    [[nodiscard]] vk::raii::CommandBuffer makeCommandBuffer() const;

  private:
    const Device& device_;
    vk::raii::CommandPool pool_;
    vk::raii::Semaphore semaphore_;
    uint64_t last_ = 0;
};

} // namespace froxel::gpu

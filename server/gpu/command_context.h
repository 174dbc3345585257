// Recording and submitting on one of the device's queues, ordered by one timeline semaphore.
#pragma once

#include "core/error.h"
#include "gpu/device.h"

#include <cstdint>
#include <functional>

namespace froxel::gpu {

class Timeline;

// Of one timeline; null: none.
struct TimelineMoment {
    const Timeline* timeline = nullptr;
    uint64_t value = 0;
};

// One thread. Every submission gets the next value of the timeline.
class Timeline {
  public:
    explicit Timeline(const Device& device) : Timeline(device, device.queue()) {}
    Timeline(const Device& device, const Queue& queue);

    // `after`: of another queue, which the commands wait for, and see what was written before.
    // Throws vk::DeviceLostError.
    uint64_t submit(const vk::raii::CommandBuffer& cmd, const TimelineMoment& after = {});
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
    const Queue& queue_;
    vk::raii::CommandPool pool_;
    vk::raii::Semaphore semaphore_;
    uint64_t last_ = 0;
};

} // namespace froxel::gpu

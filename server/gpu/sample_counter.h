// How many samples passed the depth test in part of a frame (an occlusion query).
#pragma once

#include "gpu/device.h"

#include <cstdint>

namespace froxel::gpu {

class SampleCounter {
  public:
    // The device has traits().counts_samples.
    explicit SampleCounter(const Device& device);

    // Around draws, outside of rendering; once a recording.
    void begin(const vk::raii::CommandBuffer& cmd);
    void end(const vk::raii::CommandBuffer& cmd) const;
    // Only after the frame has completed.
    [[nodiscard]] uint64_t read() const;

  private:
    vk::raii::QueryPool pool_;
};

} // namespace froxel::gpu

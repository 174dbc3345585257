// How many samples passed the depth test in parts of a frame (occlusion queries).
#pragma once

#include "gpu/device.h"

#include <cstdint>

namespace froxel::gpu {

class SampleCounter {
  public:
    static constexpr uint32_t kMaxParts = 1024;

    // The device has traits().counts_samples.
    explicit SampleCounter(const Device& device);

    // Host side, before recording the first part; the last frame's has completed.
    void restart();
    // Around the draws of a part, outside of rendering.
    void begin(const vk::raii::CommandBuffer& cmd);
    void end(const vk::raii::CommandBuffer& cmd) const;
    // Of all parts; only after the frame has completed.
    [[nodiscard]] uint64_t read() const;

  private:
    vk::raii::QueryPool pool_;
    uint32_t part_count_ = 0;
};

} // namespace froxel::gpu

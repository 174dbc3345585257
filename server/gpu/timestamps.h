// GPU time of each labelled pass of one frame.
#pragma once

#include "core/frame_stats.h"
#include "gpu/device.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace froxel::gpu {

// Fills passes and gpu_us, as Timestamps::read() does, from the begin and end of each name in turn,
// in ticks. 0 was not written; a time that needs it is none. Pure.
void addTimes(const std::vector<std::string>& names,
              std::span<const uint64_t> ticks,
              double us_per_tick,
              bool cut,
              FrameStats& stats);

class Timestamps {
  public:
    static constexpr uint32_t kMaxPasses = 4096; // parts of passes, where frames are cut

    explicit Timestamps(const Device& device);

    // Forgets the last frame; host side, before recording.
    void reset();
    // Opens and closes a pass: one debug label and two timestamps of the same name. Not nested.
    void begin(const vk::raii::CommandBuffer& cmd, const char* name);
    void end(const vk::raii::CommandBuffer& cmd);
    // Fills passes, parts of one name together, and gpu_us: from the first to the last, or where
    // others may have drawn between parts (`cut`) their sum. Only after the frame has completed.
    void read(FrameStats& stats, bool cut) const;

  private:
    const Device& device_;
    vk::raii::QueryPool pool_;
    std::vector<std::string> names_;
};

// Scope of one pass.
class PassScope {
  public:
    PassScope(Timestamps& timestamps, const vk::raii::CommandBuffer& cmd, const char* name)
        : timestamps_(timestamps), cmd_(cmd) {
        timestamps_.begin(cmd_, name);
    }
    ~PassScope() { timestamps_.end(cmd_); }
    PassScope(const PassScope&) = delete;
    PassScope& operator=(const PassScope&) = delete;

  private:
    Timestamps& timestamps_;
    const vk::raii::CommandBuffer& cmd_;
};

} // namespace froxel::gpu

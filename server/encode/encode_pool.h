// Where pictures are encoded, in two lanes: most within milliseconds; large and lossless ones, and
// those that are prepared first, which take up to seconds, on threads of their own that give way to
// others. So nobody's picture waits for a huge one or for other viewers' comparisons, and on a CPU
// device drawing does not share its cores with them. When a lane's
// queue is full, submit() refuses at once and never waits: the caller decides what to drop.
#pragma once

#include "encode/encode_lane.h"

namespace froxel::encode {

class EncodePool {
  public:
    // Pictures of more are large: 2560x1440 is not.
    static constexpr uint64_t kLargeArea_px = 4'000'000;

    // Threads and queue of each lane.
    EncodePool(size_t thread_count, size_t queue_limit);

    // Takes the job (moved from) and returns true, or leaves it untouched and returns false when
    // queue_limit jobs are waiting in its lane. Any thread.
    [[nodiscard]] bool submit(EncodeJob&& job);
    // Takes the owner's lossless job back, unless it was begun; `done` is not called. Any thread.
    [[nodiscard]] bool withdrawLossless(const void* owner) {
        return patient_.withdrawLossless(owner);
    }
    // Of one lane.
    [[nodiscard]] size_t threadCount() const { return quick_.threadCount(); }

  private:
    EncodeLane quick_;
    EncodeLane patient_;
};

} // namespace froxel::encode

// The key frames that a session's viewers ask for.
#pragma once

#include "core/allowance.h"
#include "session/stream_port.h"

#include <optional>

namespace froxel::net {

// Its session's lock covers it.
class VideoNeed {
  public:
    VideoNeed(double keys_at_once, double keys_per_second) : keys_(keys_at_once, keys_per_second) {}

    // Whether a key frame is on its way already.
    [[nodiscard]] bool waits() const { return wanted_; }
    // From now on one is; too early: it is not, and when to ask again.
    [[nodiscard]] std::optional<TimePoint> want(TimePoint now) {
        if (!keys_.take(now)) {
            return keys_.nextAt(now);
        }
        wanted_ = true;
        return {};
    }
    // A picture came, of a session that has video or has none any more.
    void note(const session::ReadyFrame& frame, bool has_video) {
        wanted_ = wanted_ && has_video && !(frame.record.key && frame.isVideo());
    }

  private:
    bool wanted_ = false; // and none has come yet
    Allowance keys_;
};

} // namespace froxel::net

// How long a thread has been at one step of its work. One thread beats, any thread asks.
#pragma once

#include "core/clock.h"

#include <atomic>

namespace froxel {

class Heartbeat {
  public:
    // A step of work begins.
    void beat(TimePoint now) { step_began_ = now.time_since_epoch().count(); }
    // The thread waits for work, which may take any time.
    void rest() { step_began_ = kResting; }

    // 0 while it rests.
    [[nodiscard]] Seconds stepTime(TimePoint now) const {
        const Clock::rep began = step_began_;
        return began == kResting ? Seconds(0) : Seconds(now - TimePoint(Clock::duration(began)));
    }

  private:
    static constexpr Clock::rep kResting = -1;
    std::atomic<Clock::rep> step_began_ = kResting;
};

} // namespace froxel

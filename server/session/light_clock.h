// The lights' time as a closed form of the host's clock: pausing, resuming and changing speed
// never make it jump, and reading it changes nothing.
#pragma once

#include "core/clock.h"

#include <optional>

namespace froxel::session {

class LightClock {
  public:
    LightClock(TimePoint now, double speed, bool running)
        : since_(now), speed_(speed), running_(running) {}

    [[nodiscard]] double secondsAt(TimePoint now) const {
        return running_ ? base_s_ + speed_ * Seconds(now - since_).count() : base_s_;
    }
    // The same time at `now`, another rate after it.
    [[nodiscard]] LightClock withRate(TimePoint now, double speed, bool running) const {
        LightClock clock(now, speed, running);
        clock.base_s_ = secondsAt(now);
        return clock;
    }
    // Another time at `now`, the same rate.
    [[nodiscard]] LightClock withTime(TimePoint now, double seconds) const {
        LightClock clock(now, speed_, running_);
        clock.base_s_ = seconds;
        return clock;
    }
    // Where it stands; none while time passes.
    [[nodiscard]] std::optional<double> stoppedAt() const {
        return moving() ? std::nullopt : std::optional(base_s_);
    }
    // Whether time passes at all, that is, whether pictures change by themselves.
    [[nodiscard]] bool moving() const { return running_ && speed_ > 0; }

  private:
    double base_s_ = 0;
    TimePoint since_;
    double speed_;
    bool running_;
};

} // namespace froxel::session

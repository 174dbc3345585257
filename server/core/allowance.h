// How often something may happen, or how much of it: so much at once, then so much a second. Pure:
// time is passed in.
#pragma once

#include "core/clock.h"

#include <algorithm>

namespace froxel {

class Allowance {
  public:
    Allowance(double at_once, double per_second) : most_(at_once), per_second_(per_second) {}

    // Whether it may happen now; counts it if so.
    [[nodiscard]] bool take(TimePoint now) {
        left_ = leftAt(now);
        at_ = std::max(at_, now);
        if (left_ < 1) {
            return false;
        }
        --left_;
        return true;
    }
    // Counts so much of it, also where that is more than is left.
    void spend(double amount, TimePoint now) {
        left_ = leftAt(now) - amount;
        at_ = std::max(at_, now);
    }
    // When take() will do; `now` if it does already.
    [[nodiscard]] TimePoint nextAt(TimePoint now) const {
        const Seconds wait((1 - leftAt(now)) / per_second_);
        return wait.count() > 0 ? now + std::chrono::ceil<Clock::duration>(wait) : now;
    }

    // How much may happen at once; all before the first. Below 0: what was spent beyond.
    [[nodiscard]] double leftAt(TimePoint now) const {
        const Seconds since = std::max(Seconds(0), Seconds(now - at_));
        return std::min(most_, left_ + per_second_ * since.count());
    }

  private:
    double most_;
    double per_second_;
    double left_ = most_;
    TimePoint at_{};
};

} // namespace froxel

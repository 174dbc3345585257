// How many bad messages a connection may send: at most kMaxRejects in any kRejectPeriod.
#pragma once

#include "core/clock.h"
#include "protocol/limits.h"

#include <deque>

namespace froxel::session {

class RejectBudget {
  public:
    // Counts one refused message; false when the budget is spent and the connection must close.
    [[nodiscard]] bool spend(TimePoint now) {
        while (!spent_.empty() && now - spent_.front() >= protocol::kRejectPeriod) {
            spent_.pop_front();
        }
        spent_.push_back(now);
        return spent_.size() <= protocol::kMaxRejects;
    }

  private:
    std::deque<TimePoint> spent_; // within the last period, oldest first
};

} // namespace froxel::session

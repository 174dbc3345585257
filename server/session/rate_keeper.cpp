#include "session/rate_keeper.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace froxel::session {
namespace {

using namespace std::chrono_literals;

constexpr double kWeight = 1.0 / 4;
// Frames at a step before it is judged, and those of them that do not count: others who share the
// device may still be about to make the same step.
constexpr uint32_t kEvidence = 4;
constexpr uint32_t kSettling = 1;
constexpr double kOver = 1.05; // of the time for a frame
constexpr double kUnder = 0.9;
// Without an error frames take at least so many times as long as with the largest, or there is
// none.
constexpr double kWorthErrors = 1.1;
constexpr Seconds kFirstHold = 1s;
constexpr Seconds kLongestHold = 30s;

} // namespace

void RateKeeper::setTarget(double fps, bool coarser_levels) {
    if (fps != fps_ || coarser_levels != levels_) {
        *this = {};
        fps_ = fps;
        levels_ = coarser_levels;
    }
}

void RateKeeper::moveTo(Step step, TimePoint now) {
    step_ = step;
    cost_.reset();
    seen_ = 0;
    moved_at_ = now;
}

// Part of a frame's cost does not go with its area, so this asks for a little too much.
Seconds RateKeeper::costAtScale(size_t scale) const {
    const double side = kScales[scale] / kScales[step_.scale];
    return *cost_ * (side * side);
}

void RateKeeper::giveMore(TimePoint now) {
    hold_ = climbed_ ? std::min(kLongestHold, std::max(kFirstHold, 2 * hold_)) : kFirstHold;
    climbed_ = false;
    if (levels_ && errors_help_ && step_.scale == 0) {
        if (step_.error + 1 < kErrors_px.size()) {
            left_at_ = *cost_;
            moveTo({0, step_.error + 1}, now);
            return;
        }
        errors_help_ = std::accumulate(saves_.begin() + 1, saves_.end(), 1.0, std::multiplies<>()) >
                       kWorthErrors;
    }
    const Seconds budget(1 / fps_);
    size_t scale = step_.scale + 1;
    while (scale + 1 < kScales.size() && costAtScale(scale) > budget) {
        ++scale;
    }
    moveTo({scale, errors_help_ ? step_.error : 0}, now);
}

void RateKeeper::onFrame(Seconds cost, const Relief& with, TimePoint now) {
    if (fps_ <= 0 || !(with == relief())) {
        return; // begun before the last step
    }
    if (++seen_ <= kSettling) {
        return;
    }
    cost_ = cost_ ? *cost_ + (cost - *cost_) * kWeight : cost;
    if (seen_ < kEvidence) {
        return;
    }
    if (step_.scale == 0 && step_.error > 0 && !climbed_ && seen_ == kEvidence) {
        saves_[step_.error] = left_at_ / *cost_;
    }
    const Seconds budget(1 / fps_);
    const auto fits = [&](Seconds next) { return next < kUnder * budget; };
    if (*cost_ > kOver * budget) {
        if (step_.scale + 1 < kScales.size()) {
            giveMore(now);
        }
    } else if (now - moved_at_ < hold_) {
        return;
    } else if (step_.scale > 0 && fits(costAtScale(step_.scale - 1))) {
        climbed_ = true;
        moveTo({step_.scale - 1, step_.error}, now);
    } else if (step_.scale == 0 && step_.error > 0 && fits(*cost_ * saves_[step_.error])) {
        climbed_ = true;
        moveTo({0, step_.error - 1}, now);
    } else if (step_.scale == 0 && step_.error == 0) {
        errors_help_ = true; // another time they may
    }
}

} // namespace froxel::session

#include "session/render_scale.h"

#include <algorithm>

namespace froxel::session {
namespace {

using namespace std::chrono_literals;

constexpr double kWeight = 1.0 / 4;
// Frames at a scale before it is judged, and those of them that do not count: others who share the
// device may still be about to make the same step.
constexpr uint32_t kEvidence = 4;
constexpr uint32_t kSettling = 1;
constexpr double kOver = 1.05; // of the time for a frame
constexpr double kUnder = 0.9;
constexpr Seconds kFirstHold = 1s;
constexpr Seconds kLongestHold = 30s;

} // namespace

void RenderScale::setTarget(double fps) {
    if (fps != fps_) {
        *this = {};
        fps_ = fps;
    }
}

void RenderScale::moveTo(size_t step, TimePoint now) {
    step_ = step;
    cost_.reset();
    seen_ = 0;
    moved_at_ = now;
}

void RenderScale::onFrame(Seconds cost, double at_scale, TimePoint now) {
    if (fps_ <= 0 || at_scale != scale()) {
        return; // begun before the last step
    }
    if (++seen_ <= kSettling) {
        return;
    }
    cost_ = cost_ ? *cost_ + (cost - *cost_) * kWeight : cost;
    if (seen_ < kEvidence) {
        return;
    }
    const Seconds budget(1 / fps_);
    // Part of a frame's cost does not go with its area, so this asks for a little too much.
    const auto costAt = [&](size_t step) {
        const double side = kScales[step] / scale();
        return *cost_ * (side * side);
    };
    if (*cost_ > kOver * budget && step_ + 1 < kScales.size()) {
        hold_ = climbed_ ? std::min(kLongestHold, std::max(kFirstHold, 2 * hold_)) : kFirstHold;
        size_t step = step_ + 1;
        while (step + 1 < kScales.size() && costAt(step) > budget) {
            ++step;
        }
        climbed_ = false;
        moveTo(step, now);
    } else if (step_ > 0 && now - moved_at_ >= hold_ && costAt(step_ - 1) < kUnder * budget) {
        climbed_ = true;
        moveTo(step_ - 1, now);
    }
}

} // namespace froxel::session

// How fast a device draws, by the frames that it has drawn. Plain arithmetic, one thread.
//
// Its speed is measured when it is opened, which may be while something else keeps its cores busy:
// a server is usually started right after a build. Frames tell better. Estimates are never exact,
// and some views are easier than theirs, so each view has a pace of its own; a new one begins at
// the device's, which all frames move.
#pragma once

#include "core/clock.h"

#include <algorithm>
#include <cmath>

namespace froxel::stream {

class DevicePace {
  public:
    DevicePace() = default;
    explicit DevicePace(double pace) : pace_(std::clamp(pace, kLeast, kMost)) {}

    // A frame took so long that by the unit costs of the start would take `expected`. `limit`: the
    // longest that one may take.
    void onFrame(Seconds expected, Seconds took, Seconds limit) {
        if (expected <= Seconds(0) || std::max(expected, took) < kWorthKnowing * limit) {
            return; // what every frame takes besides would count for too much
        }
        // A frame may be slow since something else ran; none is fast by chance.
        const double ratio = std::clamp(took / expected, kLeast, kMost);
        const double weight = ratio < pace_ ? kDown : kUp;
        pace_ *= std::pow(ratio / pace_, weight);
    }

    // Times as long as expected.
    [[nodiscard]] double value() const { return pace_; }

  private:
    // Three starts on one busy machine differed by a factor of 19.
    static constexpr double kLeast = 1.0 / 32;
    static constexpr double kMost = 4;
    static constexpr double kWorthKnowing = 0.02;
    static constexpr double kDown = 0.3;
    static constexpr double kUp = 0.1;

    double pace_ = 1;
};

} // namespace froxel::stream

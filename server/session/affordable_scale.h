// The resolution at which a picture takes no longer than one may. Pure; one thread at a time.
//
// A picture that would take too long is drawn smaller instead of refused. Its estimate says by how
// much; later ones, and what they took, say when it may grow. Where even the smallest would take
// too long, as in a scene that is too large for the device, the first picture may take what it
// takes, and those after it as long again.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace froxel::session {

class AffordableScale {
  public:
    static constexpr double kLeast = 1.0 / 16; // of each side

    // A picture at this scale is this many times too much by its area; `first`: none was drawn of
    // this scene. Whether another try is of use.
    bool onTooLong(double too_large_by, bool first) {
        if (!(too_large_by > 1)) {
            return false;
        }
        if (scale_ > kLeast) {
            scale_ = std::max(kLeast, scale_ / std::sqrt(too_large_by * kCaution));
            tries_ = 0;
            return true;
        }
        if (first) {
            limit_share_ *= too_large_by * kLeeway;
        }
        return first;
    }
    // There is no memory for one at this scale; the last one was drawn at `drawn_scale`. Whether
    // that is less, and is kept from now on.
    bool onNoRoom(double drawn_scale) {
        if (!(drawn_scale < scale_)) {
            return false;
        }
        scale_ = most_ = drawn_scale;
        return true;
    }
    // Another picture is asked for, for which there may be room.
    void forgetRoom() { most_ = 1; }
    // One at this scale takes so much of what it may by its estimate.
    void onEstimate(double limit_share, double scale) {
        if (scale != scale_ || scale_ >= most_ || limit_share <= 0) {
            return;
        }
        const double next = std::min(most_, scale_ / std::sqrt(limit_share * kCaution));
        if (next == most_ || next > scale_ * kWorthAStep) {
            scale_ = next;
            tries_ = 0;
        }
    }
    // It took so much of that. Whether a view that rests is to be drawn again, since it may grow.
    bool onTook(double limit_share, double scale) {
        const bool too_small = scale == scale_ && scale_ < most_ &&
                               limit_share * kCaution * kWorthAStep * kWorthAStep < 1;
        return scale < scale_ || (too_small && ++tries_ <= kMostTries);
    }

    [[nodiscard]] double scale() const { return scale_; }
    // Times the longest that a picture may take.
    [[nodiscard]] double limitShare() const { return limit_share_; }

  private:
    // Not all of a picture's cost goes by its area.
    static constexpr double kCaution = 1.2;
    static constexpr double kWorthAStep = 1.15;
    static constexpr double kLeeway = 2;
    // After so many frames their estimates are those of the device's real pace.
    static constexpr uint32_t kMostTries = 12;

    double scale_ = 1;
    double most_ = 1;    // that there is memory for
    uint32_t tries_ = 0; // at this scale
    double limit_share_ = 1;
};

} // namespace froxel::session

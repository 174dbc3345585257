// How finely a view's frames are cut, by how long its pieces took. Plain arithmetic, one thread.
#pragma once

#include "core/clock.h"

#include <algorithm>

namespace froxel::stream {

// Estimates know how much there is to do, and neither how badly its textures lie nor who else keeps
// the cores busy: pieces of storms took up to eight times as long. One that took too long makes all
// that follow it shorter, and each frame that kept within the limit gives a little of that back. A
// view of which nothing is known yet begins fine.
class PieceShare {
  public:
    explicit PieceShare(Seconds limit) : limit_(limit) {}

    void onPiece(Seconds took) {
        if (took > limit_) {
            share_ = std::max(kLeast, share_ * (limit_ / took));
            kept_ = false;
        }
    }
    void onFrame() {
        share_ = kept_ ? std::min(1.0, share_ * kRecovery) : share_;
        kept_ = true;
    }

    // Of the limit, for a piece by its estimate.
    [[nodiscard]] double value() const { return share_; }

  private:
    static constexpr double kFirst = 0.25;
    static constexpr double kLeast = 1.0 / 32;
    static constexpr double kRecovery = 1.05;

    const Seconds limit_;
    double share_ = kFirst;
    bool kept_ = true; // within the limit, by all pieces of the present frame
};

} // namespace froxel::stream

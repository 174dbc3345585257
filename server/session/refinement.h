// When a view that rests is shown better than while it moved, and how far. Pure: no clock, no
// threads.
//
//   change ---- kSettleAfter ----> settled or high ---- kLosslessAfter ----> lossless, the last
//
// Both times count from the last change, so that input cancels whatever has not begun. What the
// link would take too long for is left out: bytes on their way cannot be called back, and input
// would wait behind them.
#pragma once

#include "session/delivery.h"

#include <cstdint>
#include <optional>

namespace froxel::session {

class RefinementSchedule {
  public:
    static constexpr Seconds kSettleAfter{0.15};
    static constexpr Seconds kLosslessAfter{0.4};
    // How long a refined picture may keep the link busy.
    static constexpr Seconds kMostOfTheLink{1.0};
    // Bits a pixel of the built-in hall at 640x360: quality 92 with full chroma, and PNG.
    static constexpr double kHighBits = 4.6;
    static constexpr double kLosslessBits = 12.2;

    // Something was asked for, or moves.
    void onChange(TimePoint now);
    // A frame was begun at this stage; `limited`: below what was asked for.
    void onBegun(Refinement stage, bool limited);
    // It came to nothing and has to be made again.
    void onLost();

    struct Due {
        Refinement stage = Refinement::kSettled;
        TimePoint at;
    };
    // What comes next if nothing changes; none: the picture is as good as it will be.
    [[nodiscard]] std::optional<Due>
    next(settings::Refine wanted, const Delivery& delivery, settings::Size size) const;

  private:
    TimePoint changed_at_;
    Refinement shown_ = Refinement::kLossless; // nothing before the first frame
    bool limited_ = false;
};

} // namespace froxel::session

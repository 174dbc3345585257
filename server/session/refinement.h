// When a view that rests is shown better than while it moved, and how far. Pure: no clock, no
// threads.
//
//   change ---- kSettleAfter ----> settled or high ---- kSmoothAfter ----> smooth or lossless
//
// Both times count from the last change, so that input cancels whatever has not begun. The last
// stage is the mean of several frames, which are begun one by one. What the link would take too
// long for is left out: bytes on their way cannot be called back, and input would wait behind them.
#pragma once

#include "session/delivery.h"
#include "settings/samples.h"

#include <cstdint>
#include <optional>

namespace froxel::session {

// Samples a pixel of a view that rests; 1: the mean would be too much, or no picture.
[[nodiscard]] uint32_t restingSamples(const settings::ViewSettings& settings);

class RefinementSchedule {
  public:
    static constexpr Seconds kSettleAfter{0.15};
    static constexpr Seconds kSmoothAfter{0.4};
    // How long a refined picture may keep the link busy.
    static constexpr Seconds kMostOfTheLink{1.0};
    // Bits a pixel of the built-in hall at 640x360: quality 92 with full chroma, and PNG.
    static constexpr double kHighBits = 4.6;
    static constexpr double kLosslessBits = 12.2;

    // Which frame of those that a stage takes.
    struct Due {
        Refinement stage = Refinement::kSettled;
        TimePoint at;
        uint32_t sample = 0;
        uint32_t sample_count = 1;
    };

    // Something was asked for, or moves.
    void onChange(TimePoint now);
    // A frame was begun at this stage; `limited`: below what was asked for.
    void onBegun(Refinement stage, bool limited);
    // What was begun of the last stage is gone.
    void onSamplesLost();
    // There is no room for several samples of what rests.
    void onSamplesRefused();

    // What comes next if nothing changes; none: the picture is as good as it will be.
    [[nodiscard]] std::optional<Due> next(settings::Refine wanted,
                                          const Delivery& delivery,
                                          const settings::ViewSettings& settings,
                                          uint32_t most_samples = settings::kMeanSamples) const;

  private:
    TimePoint changed_at_;
    Refinement shown_ = Refinement::kLossless; // nothing before the first frame
    uint32_t begun_ = settings::kMeanSamples;  // of that stage's frames
    bool limited_ = false;
    bool samples_refused_ = false;
};

} // namespace froxel::session

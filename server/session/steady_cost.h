// What frames cost, smoothed, and deaf to one that stands alone: the first frame of new settings
// compiles pipelines, which takes as long as ten or a hundred others. Pure; one thread.
#pragma once

#include "core/clock.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace froxel::session {

class SteadyCost {
  public:
    void add(Seconds cost) {
        last_[count_++ % last_.size()] = cost;
        if (count_ < last_.size()) {
            mean_ = mean_ ? std::min(*mean_, cost) : cost; // the dearer one may be such a frame
            return;
        }
        auto sorted = last_;
        std::sort(sorted.begin(), sorted.end());
        *mean_ += (sorted[1] - *mean_) * kWeight;
    }
    // None before the first.
    [[nodiscard]] std::optional<Seconds> value() const { return mean_; }

    // Whether so many were added that no single one decides.
    [[nodiscard]] bool steady() const { return count_ >= last_.size(); }

  private:
    static constexpr double kWeight = 0.125; // of the newest

    std::array<Seconds, 3> last_{};
    size_t count_ = 0;
    std::optional<Seconds> mean_;
};

} // namespace froxel::session

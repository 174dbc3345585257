// A rate as a bucket that fills with time: bytes may pass while there are tokens. The caller passes
// the time; one thread.
#pragma once

#include "core/clock.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace froxel::test {

class TokenBucket {
  public:
    static constexpr double kUnlimited = std::numeric_limits<double>::infinity();
    // What a link lets through at once, as the time that it takes at the rate.
    static constexpr Seconds kBurst{0.01};
    static constexpr double kMinBurstBytes = 1500; // a packet
    static constexpr Seconds kNever{86'400};

    // Full at the start.
    TokenBucket(double bytes_per_s, TimePoint now)
        : rate_(bytes_per_s), tokens_(burstBytes()), filled_at_(now) {}

    [[nodiscard]] double bytesPerSecond() const { return rate_; }

    // What was earned until now stays, up to the new rate's burst.
    void setRate(double bytes_per_s, TimePoint now) {
        fill(now);
        rate_ = bytes_per_s;
        tokens_ = std::min(tokens_, burstBytes());
    }

    // Whether that many bytes may pass now; takes their tokens if so. At most kMinBurstBytes, so
    // that every rate lets them pass some time.
    [[nodiscard]] bool take(size_t bytes, TimePoint now) {
        fill(now);
        const auto wanted = static_cast<double>(bytes);
        if (rate_ == kUnlimited) {
            return true;
        }
        if (wanted > tokens_) {
            return false;
        }
        tokens_ -= wanted;
        return true;
    }

    // When take() will do; `now` if it does already. At rate 0 it does not: a day.
    [[nodiscard]] TimePoint whenReady(size_t bytes, TimePoint now) const {
        const double missing = static_cast<double>(bytes) - tokens_;
        if (rate_ == kUnlimited || missing <= 0) {
            return now;
        }
        const Seconds wait = rate_ > 0 ? std::min(Seconds(missing / rate_), kNever) : kNever;
        return std::max(now, filled_at_ + std::chrono::ceil<Clock::duration>(wait));
    }

  private:
    [[nodiscard]] double burstBytes() const {
        return std::max(kMinBurstBytes, rate_ * kBurst.count());
    }

    void fill(TimePoint now) {
        if (rate_ != kUnlimited && now > filled_at_) {
            tokens_ = std::min(burstBytes(), tokens_ + rate_ * Seconds(now - filled_at_).count());
        }
        filled_at_ = std::max(filled_at_, now);
    }

    double rate_;
    double tokens_;
    TimePoint filled_at_;
};

} // namespace froxel::test

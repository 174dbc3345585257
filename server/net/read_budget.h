// What one connection may have read of it, in bytes and in messages: what takes the server longer
// than reading does counts as the bytes that could have been read meanwhile. Who says more is told,
// and read more slowly; who goes on, for a quarter of a minute at all bytes, is sent away. Pure:
// time is passed in. One strand.
#pragma once

#include "core/allowance.h"
#include "protocol/limits.h"

#include <algorithm>
#include <cstddef>

namespace froxel::net {

class ReadBudget {
  public:
    static constexpr double kBytesAtOnce = 1024 * 1024;
    static constexpr double kBytesPerSecond = 128 * 1024;
    // A second of work costs as much as reading for so long.
    static constexpr double kSecondsPerWork = 12;
    // Messages and control frames, however short: at once, and a second. An acknowledgement and a
    // camera for each of 240 pictures a second are within it.
    static constexpr double kMessages = 600;
    // A message may come in fragments of a byte, each of which has a header of six.
    static constexpr size_t kMostWithoutMessage = 8 * protocol::kMaxMessageBytes;

    enum class Standing { kWithin, kThrottled, kSpent }; // from good to bad, and never back

    // Bytes that were read from the wire.
    void onBytes(size_t bytes, TimePoint now) {
        without_message_ += bytes;
        charge(static_cast<double>(bytes), now);
    }
    // A control frame came. No message, so whoever sends nothing else is sent away.
    void onControlFrame(TimePoint now) { count(now); }
    // A message is complete.
    void onMessage(TimePoint now) {
        without_message_ = 0;
        count(now);
    }
    // What a message took a thread.
    void onWork(Seconds work, TimePoint now) {
        charge(work.count() * kSecondsPerWork * kBytesPerSecond, now);
    }
    // How many bytes may be read now; 0: later.
    [[nodiscard]] size_t readable(TimePoint now) const {
        return messages_.leftAt(now) < 1 ? 0
                                         : static_cast<size_t>(std::max(0.0, pace_.leftAt(now)));
    }
    [[nodiscard]] Standing standing() const { return standing_; }

  private:
    void charge(double bytes, TimePoint now) {
        pace_.spend(bytes, now);
        patience_.spend(bytes, now);
        judge(now);
    }
    void count(TimePoint now) {
        messages_.spend(1, now);
        judge(now);
    }
    void judge(TimePoint now) {
        if (patience_.leftAt(now) < 0 || without_message_ > kMostWithoutMessage) {
            standing_ = Standing::kSpent;
        } else if (readable(now) < 1 && standing_ == Standing::kWithin) {
            standing_ = Standing::kThrottled;
        }
    }

    Allowance pace_{kBytesAtOnce, kBytesPerSecond};
    Allowance messages_{kMessages, kMessages};
    Allowance patience_{1.5 * kBytesAtOnce, 0.75 * kBytesPerSecond};
    size_t without_message_ = 0; // since the last one was complete
    Standing standing_ = Standing::kWithin;
};

} // namespace froxel::net

// One direction of a link, without sockets: a queue of bounded length, then a rate, then a delay.
// The caller passes the time; one thread.
//
//   push() -> queue (at most queue_bytes) -> token bucket -> under way for `delay` -> take()
//
// A full queue takes nothing: whoever feeds it stops reading, and TCP's own back-pressure reaches
// the sender. What is under way is bounded too: by what the rate lets through in one delay, and
// never more than kMaxUnderWayBytes.
#pragma once

#include "relay/token_bucket.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

namespace froxel::test {

struct LinkOptions {
    double bytes_per_s = TokenBucket::kUnlimited;
    std::chrono::microseconds delay{0};
    size_t queue_bytes = 64 * 1024;
};

class ShapedLink {
  public:
    static constexpr size_t kMaxUnderWayBytes = size_t{16} * 1024 * 1024;

    ShapedLink(const LinkOptions& options, TimePoint now);

    // How many bytes push() takes.
    [[nodiscard]] size_t room() const;
    // At most room() bytes.
    void push(std::span<const uint8_t> bytes, TimePoint now);
    // What has arrived by now, in its order; call it until it gives nothing.
    [[nodiscard]] std::vector<uint8_t> take(TimePoint now);
    // When take() gives more; none while nothing is on the link.
    [[nodiscard]] std::optional<TimePoint> nextDue(TimePoint now);
    void setRate(double bytes_per_s, TimePoint now);
    [[nodiscard]] bool empty() const { return queue_.empty() && under_way_.empty(); }

  private:
    struct Flight {
        TimePoint due;
        std::vector<uint8_t> bytes;
    };
    void launch(TimePoint now);

    const LinkOptions options_;
    TokenBucket bucket_;
    std::deque<uint8_t> queue_;
    std::deque<Flight> under_way_;
    size_t under_way_bytes_ = 0;
};

} // namespace froxel::test

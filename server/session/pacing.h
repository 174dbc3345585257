// Credit for one viewer: how many frames may be under way unacknowledged. One thread at a time;
// never reads a clock.
//
// A frame may be sent while fewer than window() are unacknowledged. The window is what fills the
// pipe and no more: ceil(base round trip / frame cost) + 1, reached one step per round trip and
// only while round trips stay near the base one. A round trip that grows means that frames queue
// on the way, and the window shrinks (the idea of TCP Vegas): a slow link gets fewer, fresher
// frames instead of old ones.
#pragma once

#include "core/clock.h"

#include <cstdint>
#include <deque>
#include <optional>

namespace froxel::session {

enum class AckOutcome : uint8_t {
    kFresh,   // opened the window
    kStale,   // already acknowledged; no effect
    kUnknown, // no such frame was sent
};

class CreditWindow {
  public:
    static constexpr uint32_t kInitial = 2;
    static constexpr uint32_t kMax = 8;

    [[nodiscard]] bool open() const { return inFlight() < window_; }
    [[nodiscard]] uint32_t window() const { return window_; }
    [[nodiscard]] uint32_t inFlight() const { return static_cast<uint32_t>(sent_.size()); }

    // What one frame costs the server where it is slowest (the larger of rendering and encoding);
    // smoothed. Its inverse is the rate that the window is sized for.
    void onProduced(Seconds cost);
    // When the frame's write begins; ids grow.
    void onSent(uint64_t frame_id, TimePoint now);
    // Acknowledges this frame and all before it.
    AckOutcome onAck(uint64_t frame_id, TimePoint now);

    // Lowest believable time from send to acknowledgement; none before the first.
    [[nodiscard]] std::optional<Seconds> baseRoundTrip() const { return base_; }
    // How long the oldest unacknowledged frame has been out; 0 when there is none.
    [[nodiscard]] Seconds stalledFor(TimePoint now) const;

  private:
    struct Sent {
        uint64_t frame_id;
        TimePoint at;
        uint32_t ahead; // unacknowledged frames when it was sent
    };
    void takeSample(const Sent& frame, TimePoint now);
    void adjust(Seconds round_trip, const Sent& frame, TimePoint now);
    [[nodiscard]] uint32_t target() const;

    std::deque<Sent> sent_;
    uint64_t last_sent_id_ = 0;
    uint64_t adjusted_at_id_ = 0; // frames sent before this say nothing about the present window
    uint32_t window_ = kInitial;
    TimePoint grow_after_; // a window that was too large is not tried again before
    std::optional<Seconds> base_;
    TimePoint base_confirmed_at_;
    bool probing_ = false; // window 1 until a frame has travelled alone
    std::optional<Seconds> cost_;
};

} // namespace froxel::session

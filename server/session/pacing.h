// Credit for one viewer: how many frames may be under way unacknowledged. One thread at a time;
// never reads a clock.
//
// A frame may be sent while fewer than window() are unacknowledged. The window is what fills the
// pipe and no more: ceil((base round trip + the client's decoding) / frame cost) + 1, reached one
// step per round trip and only while round trips stay near the base one. A round trip that grows
// means that frames queue on the way, and the window shrinks (the idea of TCP Vegas): a slow link
// gets fewer, fresher frames instead of old ones.
#pragma once

#include "session/steady_cost.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace froxel::session {

enum class AckOutcome : uint8_t {
    kFresh,   // opened the window
    kStale,   // already acknowledged; no effect
    kUnknown, // no such frame was sent
};

// What is told of a frame when it is sent.
struct SentAs {
    size_t bytes = 1;
    uint32_t rung = 0;
    // Of another size than its neighbours, by far: neither its round trip nor those of frames sent
    // behind it say anything about the link's queue.
    bool bulk = false;
};

// What an acknowledgement tells.
struct Trip {
    SentAs as;
    Seconds round_trip{0}; // without the client's own time
    Seconds queue{0};      // of which beyond what a frame of this size takes at best
    // Since the acknowledgement before, each frame's share where it covers several: at most what
    // the link took for it, where it had company.
    Seconds interval{0};
    uint32_t ahead = 0;   // frames on their way when it was sent
    bool measured = true; // false: bulk, or behind bulk
    // Share of the time before it was sent, back to the frame before, in which the window was shut.
    double held = 0;
    bool growing = false; // the window is below what the route needs and may grow
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
    void onSent(uint64_t frame_id, TimePoint now, const SentAs& as = {});
    // Acknowledges this frame and all before it. `client` is what the client says that it took from
    // receiving to painting, more than the round trip counts as none; `decode` is what decoding
    // took of that.
    AckOutcome onAck(uint64_t frame_id,
                     TimePoint now,
                     Seconds client = Seconds(0),
                     Seconds decode = Seconds(0));
    // Of the last fresh acknowledgement; none before the first.
    [[nodiscard]] const std::optional<Trip>& lastTrip() const { return trip_; }
    // Queues do not shrink the window below this, 1 or 2: at 2 the link is never idle, and bits a
    // frame are what has to give.
    void setFloor(uint32_t floor);
    // The next frame travels alone and measures the base round trip afresh.
    void probe();

    // Lowest believable time from send to acknowledgement; none before the first.
    [[nodiscard]] std::optional<Seconds> baseRoundTrip() const { return base_; }

  private:
    struct Sent {
        uint64_t frame_id;
        TimePoint at;
        uint32_t ahead; // unacknowledged frames when it was sent
        double held;
        bool measured;
        SentAs as;
    };
    void takeSample(const Sent& frame, Seconds round_trip, TimePoint now);
    void adjust(Seconds round_trip, const Sent& frame, TimePoint now);
    // Of a frame of this size at best.
    [[nodiscard]] Seconds expected(size_t bytes) const;
    [[nodiscard]] double takeHeld(TimePoint now);
    [[nodiscard]] uint32_t target() const;

    std::deque<Sent> sent_;
    uint64_t last_sent_id_ = 0;
    uint64_t adjusted_at_id_ = 0; // frames sent before this say nothing about the present window
    uint32_t window_ = kInitial;
    uint32_t floor_ = 1;
    TimePoint grow_after_; // a window that was too large is not tried again before
    std::optional<Seconds> base_;
    size_t base_bytes_ = 1; // of the frame that took it
    TimePoint base_confirmed_at_;
    bool probing_ = false; // window 1 until a frame has travelled alone
    SteadyCost cost_;
    Seconds decode_{0}; // smoothed
    std::optional<Trip> trip_;
    TimePoint sent_at_;  // the last frame
    TimePoint acked_at_; // the last fresh acknowledgement
    std::optional<TimePoint> shut_at_;
    Seconds shut_{0}; // since the last frame was sent, without what shut_at_ began
};

} // namespace froxel::session

// What a link carries, and how far a session's frames have to give way to it. Pure: no threads, no
// clock. Fed with the credit window's trips; a slow renderer, encoder or client never lowers
// quality.
//
// The link is too slow where credit holds frames back (the window is shut for most of the time
// between them, though it need not grow) and acknowledgements come further apart than the server
// makes frames. Then, at once, down the ladder as far as the ratio of the two asks for; a step that
// leaves the round trip of a lone frame as long as it was before was a mistake, a longer route, and
// is taken back. Up goes one rung at a time, while credit holds nothing back. A rung that failed is
// held for longer each time, and those above it as long; that is forgotten once frames travel
// clearly faster than they did, or after a stable time.
#pragma once

#include "session/pacing.h"
#include "session/rate_ladder.h"

#include <deque>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace froxel::session {

enum class RateStep : uint8_t {
    kNone,
    kCongested, // down: the link is too slow
    kRecovered, // up: it carries more
    kUndone,    // up: the step down was a mistake
};

class RateController {
  public:
    // Frames a second that the link must carry where the viewer has no target and the server could
    // make more: beyond these a better picture is worth more.
    static constexpr double kEnoughFps = 30;

    RateController() { restart({}, {}); }

    // What the viewer asked for. A change keeps the place on the ladder as far as it can.
    void setWanted(const settings::Encoding& encoding, const DeliverySettings& settings);
    // What a frame costs the server where it is slowest, at this scale.
    void onProduced(Seconds cost, double scale);
    // After every fresh acknowledgement.
    RateStep onTrip(const Trip& trip, TimePoint now);

    [[nodiscard]] const Delivery& delivery() const { return ladder_[rung_].delivery; }
    // Whether the window may shut down to a single frame.
    [[nodiscard]] bool alone() const { return ladder_[rung_].alone; }
    // Once after a step that has to be looked at: the window's next frame should travel alone.
    [[nodiscard]] bool takeProbe() { return std::exchange(probe_, false); }
    // That frames wait on the link of late; smoothed.
    [[nodiscard]] Seconds queueDelay() const { return queue_; }
    // Bits a second that the link carries; exact while it is the bottleneck, else the most that was
    // seen to get through of late. None before the first frames.
    [[nodiscard]] std::optional<double> linkRate() const { return link_rate_; }

  private:
    struct Failure {
        uint32_t count = 0;
        double link_rate = std::numeric_limits<double>::infinity(); // bits a second, when it failed
        TimePoint held_until;
    };

    void restart(const settings::Encoding& encoding, const DeliverySettings& settings);
    void noteRate(const Trip& trip, TimePoint now);
    void noteTravel(const Trip& trip);
    [[nodiscard]] double carried() const;
    [[nodiscard]] Seconds companysRoundTrip() const;
    // Whether credit has held frames back of late.
    [[nodiscard]] bool heldBack() const;
    [[nodiscard]] Seconds wantedInterval() const;
    // Bits a second at this rung, against those of the first.
    [[nodiscard]] double demand(size_t rung) const;
    // What the link takes for a frame, where it is too slow.
    [[nodiscard]] std::optional<Seconds> overload() const;
    [[nodiscard]] bool roomAbove(TimePoint now) const;
    void stepDown(Seconds link_interval, TimePoint now);
    void moveTo(uint32_t rung, TimePoint now);

    settings::Encoding asked_;
    DeliverySettings settings_;
    std::vector<Rung> ladder_;
    std::vector<Failure> failures_; // by rung
    uint32_t rung_ = 0;
    TimePoint moved_at_;
    SteadyCost full_cost_; // of a frame at full scale
    SteadyCost cost_;      // at the present one

    // At this rung.
    std::deque<Trip> recent_; // the last few
    uint32_t seen_ = 0;
    // What frames take of late and took for longer: lone ones' round trips, and the link's own time
    // for those in company.
    uint32_t paced_ = 0;
    Seconds pace_fast_{0};
    Seconds pace_slow_{0};

    Seconds queue_{0};
    std::optional<double> link_rate_;
    TimePoint link_rate_at_;
    // Of frames in company since the last rate was taken.
    double rate_bits_ = 0;
    Seconds rate_took_{0};
    bool probe_ = false;
    // A step down that a lone frame has yet to confirm: from where, and how long frames travelled.
    struct Doubt {
        uint32_t rung;
        Seconds round_trip;
        std::vector<Failure> failures; // as they were
    };
    std::optional<Doubt> doubt_;
    TimePoint sure_until_;
};

} // namespace froxel::session

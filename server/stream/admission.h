// Whether one more session fits on the device. Pure: no threads, no clock of its own.
//
// What the active sessions need to have the floor rate, each at the cost of its own frames, and one
// more at their mean cost, must not pass the device's time. A session that draws less than the
// floor by itself (its lights stand, its link is slow) counts with what it draws, an idle one as
// nothing, and one that has not drawn yet but would as another at the mean cost, so that a crowd
// that comes at once is not let in on the word of the few. Where nobody draws, that mean is of the
// frames before, at first of one that was drawn for it; one session is always let in.
#pragma once

#include "core/error.h"
#include "session/steady_cost.h"

#include <cstdint>
#include <map>
#include <optional>

namespace froxel::stream {

class Admission {
  public:
    // What rates are measured over; a session that drew nothing for so long is idle.
    static constexpr Seconds kWindow{2};
    // How long one that has not drawn yet is expected to.
    static constexpr Seconds kPatience{10};

    // Frames a second that every active session must keep; 0: everyone is let in.
    explicit Admission(double min_rate_hz = 0) : min_rate_hz_(min_rate_hz) {}
    // And the device time of a frame, until sessions have drawn some; none: unknown.
    void setMinRate(double min_rate_hz, std::optional<Seconds> frame_cost = {});

    void add(uint64_t session, TimePoint now);
    void remove(uint64_t session);
    // A session of which nothing is known is expected to draw unless it takes no frames: paused
    // from the start, it costs nothing.
    void setTakesFrames(uint64_t session, bool takes, TimePoint now);
    // Device time that one frame of this session took.
    void onFrame(uint64_t session, Seconds cost, TimePoint now);

    // kCapacity, with the figures in one line, where one more session is too much.
    [[nodiscard]] Result<void> check(TimePoint now) const;
    // What is taken of what may be let in: 0 where nobody needs anything, 1 where one more session
    // is too much. 0 without a floor rate, too.
    [[nodiscard]] double load(TimePoint now) const;

  private:
    struct Entry {
        std::optional<TimePoint> expected_since; // to draw
        session::SteadyCost cost;
        // Frames of the present window and of the one before it.
        TimePoint window_begin{};
        uint32_t window_count = 0;
        uint32_t before_count = 0;
    };
    // Of the device's time, 1 being all of it; at the floor rate.
    struct Needs {
        double busy = 0;     // by the sessions that are there
        double one_more = 0; // by another one; 0: unknown
        double mean_s = 0;   // a frame
        uint32_t active = 0;
    };
    [[nodiscard]] Needs needs(TimePoint now) const;
    [[nodiscard]] static double rateOf(const Entry& entry, TimePoint now);

    double min_rate_hz_;
    session::SteadyCost typical_cost_; // of frames of late, whoever's
    std::map<uint64_t, Entry> sessions_;
};

} // namespace froxel::stream

// Whether one more session fits on the device. Pure: no threads, no clock of its own.
//
// What the active sessions need to have the floor rate, each at the cost of its own frames, and one
// more at the cost of the first picture that a viewer sees, must not pass the device's time. A
// session that draws less than the floor by itself (its lights stand, its link is slow) counts with
// what it draws, an idle one as nothing, and one that has not drawn yet but would as another
// newcomer, so that a crowd that comes at once is not let in on the word of the few.
//
// Other accounts than the newcomer's count with their fair share at most, which is all that the
// scheduler gives them once the newcomer draws: whatever one account asks for, there is room for
// others. Where nobody draws, one session is always let in.
#pragma once

#include "core/error.h"
#include "session/account.h"
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
    // And the device time of a newcomer's frame; none: unknown, and nothing is held against it.
    void setMinRate(double min_rate_hz, std::optional<Seconds> frame_cost = {});
    void setNewcomersCost(Seconds frame_cost) { newcomer_cost_ = frame_cost; }

    void add(uint64_t session, const session::Account& account, TimePoint now);
    void remove(uint64_t session);
    // A session of which nothing is known is expected to draw unless it takes no frames: paused
    // from the start, it costs nothing.
    void setTakesFrames(uint64_t session, bool takes, TimePoint now);
    // Device time that one frame of this session took.
    void onFrame(uint64_t session, Seconds cost, TimePoint now);

    // kCapacity, with the figures in one line, where one more session of this account is too much.
    [[nodiscard]] Result<void> check(const session::Account& account, TimePoint now) const;
    // What is taken of what may be let in: 0 where nobody needs anything, 1 where one more session
    // of the account that needs most is too much. 0 without a floor rate, too.
    [[nodiscard]] double load(TimePoint now) const;

  private:
    struct Entry {
        session::Account account;
        std::optional<TimePoint> expected_since; // to draw
        session::SteadyCost cost;
        // Frames of the present window and of the one before it.
        TimePoint window_begin{};
        uint32_t window_count = 0;
        uint32_t before_count = 0;
    };
    // Of the device's time, 1 being all of it; at the floor rate.
    struct Needs {
        std::map<session::Account, double> accounts; // those that draw or are expected to
        uint32_t active = 0;                         // sessions
        double one_more = 0;
    };
    [[nodiscard]] Needs needs(TimePoint now) const;
    // By all that are there, where one more session of this account is to be let in.
    [[nodiscard]] static double busyFor(const session::Account& account, const Needs& needs);
    [[nodiscard]] static double rateOf(const Entry& entry, TimePoint now);

    double min_rate_hz_;
    Seconds newcomer_cost_{0}; // of a frame
    std::map<uint64_t, Entry> sessions_;
};

} // namespace froxel::stream

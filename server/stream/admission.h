// Whether one more session fits on the device. Pure: no threads, no clock of its own.
//
// What the sessions may ask for at the floor rate, and one more at the cost of a newcomer's moving
// view, must not pass the device's time. A session counts with the cost of its own moving view, or
// a newcomer's before that is known: a view that rests costs little while its lights move and
// nothing while they stand, but it moves when its viewer does. One that takes no frames, or has
// drawn none for long, counts as nothing.
//
// Other accounts than the newcomer's count with their fair share at most, which is all that the
// scheduler gives them once the newcomer draws: whatever one account asks for, there is room for
// others. Where nobody is, one session is always let in.
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
    // Whoever drew nothing for so long has forgotten the view.
    static constexpr Seconds kForgotten{300};

    // Frames a second that every session must be able to keep; 0: everyone is let in.
    explicit Admission(double min_rate_hz = 0) : min_rate_hz_(min_rate_hz) {}
    // And the device time of a newcomer's frame; none: unknown, and nothing is held against it.
    void setMinRate(double min_rate_hz, std::optional<Seconds> frame_cost = {});
    void setNewcomersCost(Seconds frame_cost) { newcomer_cost_ = frame_cost; }

    void add(uint64_t session, const session::Account& account, TimePoint now);
    void remove(uint64_t session);
    // Whether any of its viewers takes frames: paused, it costs nothing.
    void setTakesFrames(uint64_t session, bool takes, TimePoint now);
    // Device time that one frame of this session took. `reused`: it rests on the surfaces of the
    // one before it.
    void onFrame(uint64_t session, Seconds cost, TimePoint now, bool reused = false);

    // kCapacity, with the figures in one line for the log, where one more session of this account
    // is too much.
    [[nodiscard]] Result<void> check(const session::Account& account, TimePoint now) const;
    // What is taken of what may be let in: 0 where nobody needs anything, 1 where one more session
    // of the account that needs most is too much. 0 without a floor rate, too.
    [[nodiscard]] double load(TimePoint now) const;

  private:
    struct Entry {
        session::Account account;
        bool takes_frames = true;
        TimePoint seen{}; // drawing, or joining
        session::SteadyCost moving;
        session::SteadyCost reused;
    };
    // Of the device's time, 1 being all of it; at the floor rate.
    struct Needs {
        std::map<session::Account, double> accounts;
        uint32_t active = 0; // sessions
        double one_more = 0;
    };
    [[nodiscard]] Needs needs(TimePoint now) const;
    [[nodiscard]] Seconds costOf(const Entry& entry) const;
    // By all that are there, where one more session of this account is to be let in.
    [[nodiscard]] static double busyFor(const session::Account& account, const Needs& needs);

    double min_rate_hz_;
    Seconds newcomer_cost_{0}; // of a frame
    std::map<uint64_t, Entry> sessions_;
};

} // namespace froxel::stream

// Where viewers come in: into a session of their own, into a room, or back into the session that
// their lost connection left. Keeps the places of lost connections for the grace time. Any thread;
// reads no clock.
#pragma once

#include "core/allowance.h"
#include "net/caller.h"
#include "net/closing.h"
#include "net/live_session.h"
#include "net/lobby_rules.h"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace froxel::net {

// A viewer's way to its session, for as long as its connection lives.
struct Seat {
    std::shared_ptr<LiveSession> session;
    Place place;
    std::string resume_token; // of this connection; empty: when lost it is not waited for
    bool resumed = false;
    std::optional<session::ReadyFrame> picture; // the newest, to be shown at once
};

enum class Departure { kLeft, kLost };

// What a client says of itself before its Hello.
struct Announcement {
    std::string room;
    std::string resume; // session::resumeName of the token that it has
};

class Lobby {
  public:
    // Places of lost connections that are kept at most: a flood into a room must not fill memory.
    static constexpr size_t kMaxAway = 2000;

    explicit Lobby(LobbyRules rules) : rules_(rules) {}

    // Told when expire() is due next; on any thread, must not block. Set before the first viewer.
    void setAlarm(std::function<void(TimePoint)> alarm) { alarm_ = std::move(alarm); }

    // By its token into the session that it left, whatever became of it; else into hello.room; else
    // into a session of its own, for which one that rests may have to end. Errors: how the
    // connection is to close.
    [[nodiscard]] PlaceResult<Seat> enter(const Serving& serving,
                                          const session::Hello& hello,
                                          const Caller& caller,
                                          std::weak_ptr<SessionViewer> viewer,
                                          TimePoint now);
    // Whether enter() would let somebody in now who keeps to this; its errors.
    [[nodiscard]] PlaceResult<void> admits(const Serving& serving,
                                           const Announcement& announcement,
                                           const Caller& caller,
                                           TimePoint now) const;
    // Takes the control of a room from whoever has it; whether there is such a room.
    [[nodiscard]] bool takeControl(const std::string& room);
    // The client has heard of the seat's token: the one that it came with is worth nothing any
    // more.
    void settle(const Seat& seat);
    // Once for each Seat.
    void depart(const Seat& seat, Departure how, TimePoint now);
    // What expire() does for the control of one session: after somebody asked for it.
    void passIdleControl(LiveSession& session, TimePoint now);
    // Ends what was waited for in vain or forgotten, and passes on control that rests. Sets off the
    // alarm for when more is due.
    void expire(TimePoint now);
    // Waits for nobody from now on.
    void close();
    // After close(): blocks until nobody is here any more; whether that was so before the deadline.
    [[nodiscard]] bool waitUntilEmpty(TimePoint deadline) const;

    [[nodiscard]] std::chrono::milliseconds resumeGrace() const { return rules_.resume_grace; }
    // Places of lost connections.
    [[nodiscard]] size_t awayCount() const;
    // With somebody in them, or waited for; a room is one.
    [[nodiscard]] size_t sessionCount() const;

  private:
    struct Entry {
        std::shared_ptr<LiveSession> session;
        std::string room;
        session::Account address; // that it came from first
        std::string token;
        std::string token_before; // that the newest connection came with, until it has the new one
        uint64_t connection = 0;
        std::optional<TimePoint> away_until; // none: it is here
    };
    using Entries = std::map<session::MemberId, Entry>;

    [[nodiscard]] Entries::iterator findToken(const session::Hello& hello);
    [[nodiscard]] PlaceResult<Entries::iterator> addMember(const Serving& serving,
                                                           const session::Hello& hello,
                                                           const Caller& caller,
                                                           TimePoint now,
                                                           Mail& mail);
    // Whose end would let one more session of this caller in: none needed, or the one that rests
    // longest.
    [[nodiscard]] PlaceResult<std::shared_ptr<LiveSession>>
    whoGivesWay(const Serving& serving, const Caller& caller, TimePoint now) const;
    [[nodiscard]] PlaceResult<void> withinLimits(const Caller& caller) const;
    // Whether the room takes one more viewer.
    [[nodiscard]] PlaceResult<void> roomTakes(const std::string& room, const Caller& caller) const;
    void end(const LiveSession& session, const Closing& closing, Mail& mail);
    [[nodiscard]] size_t countAway() const;
    Entries::iterator remove(Entries::iterator entry, Mail& mail);

    // In words for the viewer; the figures go to the log, a line a second.
    [[nodiscard]] Closing whyNot(const Error& error, TimePoint now) const;

    mutable Allowance busy_lines_{1, 1}; // under the lock
    const LobbyRules rules_;
    std::function<void(TimePoint)> alarm_ = [](TimePoint) {};

    mutable std::mutex mutex_;
    mutable std::condition_variable emptied_;
    bool closed_ = false;
    session::MemberId last_member_ = 0;
    uint64_t last_connection_ = 0;
    Entries entries_;
    std::vector<std::shared_ptr<LiveSession>> sessions_; // with somebody in them, or waited for
    std::map<std::string, std::shared_ptr<LiveSession>> rooms_; // likewise
};

} // namespace froxel::net

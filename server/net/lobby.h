// Where viewers come in: into a session of their own, into a room, or back into the session that
// their lost connection left. Keeps the places of lost connections for the grace time. Any thread;
// reads no clock.
#pragma once

#include "net/caller.h"
#include "net/live_session.h"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

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

class Lobby {
  public:
    // Places of lost connections that are kept at most: a flood into a room must not fill memory.
    static constexpr size_t kMaxAway = 2000;

    // No place is kept with a grace of 0.
    explicit Lobby(std::chrono::milliseconds resume_grace) : grace_(resume_grace) {}

    // Told when expire() is due next; on any thread, must not block. Set before the first viewer.
    void setAlarm(std::function<void(TimePoint)> alarm) { alarm_ = std::move(alarm); }

    // By its token into the session that it left, whatever became of it; else into hello.room; else
    // into a session of its own. Errors: StreamPort::join's.
    [[nodiscard]] Result<Seat> enter(const Serving& serving,
                                     const session::Hello& hello,
                                     const Caller& caller,
                                     std::weak_ptr<SessionViewer> viewer,
                                     TimePoint now);
    // The client has heard of the seat's token: the one that it came with is worth nothing any
    // more.
    void settle(const Seat& seat);
    // Once for each Seat.
    void depart(const Seat& seat, Departure how, TimePoint now);
    // Ends what was waited for in vain. When the next one is due.
    std::optional<TimePoint> expire(TimePoint now);
    // Waits for nobody from now on.
    void close();
    // After close(): blocks until nobody is here any more; whether that was so before the deadline.
    [[nodiscard]] bool waitUntilEmpty(TimePoint deadline) const;

    [[nodiscard]] std::chrono::milliseconds resumeGrace() const { return grace_; }
    // Places of lost connections.
    [[nodiscard]] size_t awayCount() const;
    // With somebody in them, or waited for; a room is one.
    [[nodiscard]] size_t sessionCount() const;

  private:
    struct Entry {
        std::shared_ptr<LiveSession> session;
        std::string room;
        std::string token;
        std::string token_before; // that the newest connection came with, until it has the new one
        uint64_t connection = 0;
        std::optional<TimePoint> away_until; // none: it is here
    };
    using Entries = std::map<session::MemberId, Entry>;

    [[nodiscard]] Entries::iterator findToken(const session::Hello& hello);
    [[nodiscard]] Result<Entries::iterator> addMember(const Serving& serving,
                                                      const session::Hello& hello,
                                                      const Caller& caller,
                                                      TimePoint now,
                                                      Mail& mail);
    [[nodiscard]] size_t countAway() const;
    Entries::iterator remove(Entries::iterator entry, Mail& mail);

    const std::chrono::milliseconds grace_;
    std::function<void(TimePoint)> alarm_ = [](TimePoint) {};

    mutable std::mutex mutex_;
    mutable std::condition_variable emptied_;
    bool closed_ = false;
    session::MemberId last_member_ = 0;
    uint64_t last_connection_ = 0;
    Entries entries_;
    std::map<std::string, std::shared_ptr<LiveSession>> rooms_; // with somebody in them
};

} // namespace froxel::net

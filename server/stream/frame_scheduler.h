// Which viewer's piece the device is given next. Pure: no threads, no clock of its own.
//
// Accounts share the device's time, and an account's viewers share what it gets: each has a virtual
// time that grows with what it costs, and the ready one with the least goes first (start-time fair
// queueing, Goyal et al. 1996). One that was idle gets no credit for it: it resumes at the virtual
// time of the piece begun last. An account that leaves in debt comes back in debt, and so does a
// viewer within its account; debts are forgotten once virtual time, which goes on while the device
// is idle, has passed them.
//
// Who draws beside the sessions, such as single pictures for HTTP, has an account that pays more
// for what it takes, so that while others want all of the device it gets kBesideShare of it.
//
// Pieces cannot be interrupted, so a long one begun in the moment that a viewer needs to be ready
// again would cost it more than its share. Such a piece waits for those who are behind it, as long
// as they are usually ready within half of its time; the wait is charged to them (as anticipatory
// scheduling of disks, Iyer and Druschel 2001).
#pragma once

#include "core/clock.h"
#include "session/account.h"

#include <boost/container/flat_map.hpp>

#include <cstdint>
#include <map>
#include <optional>

namespace froxel::stream {

class FrameScheduler {
  public:
    // No viewer gets frames closer together than `min_interval` on average, but for onInput().
    explicit FrameScheduler(Seconds min_interval) : min_interval_(min_interval) {}

    // Of the device's time while sessions want all of it.
    static constexpr double kBesideShare = 0.05;

    void add(uint64_t viewer, const session::Account& account);
    // Beside the sessions: all of them have one account, and no pace.
    void addBeside(uint64_t viewer);
    void remove(uint64_t viewer);
    enum class Ready : uint8_t {
        kNo,
        kFrame, // has something new to show and room for it, at its pace
        kPiece, // has begun a frame of which pieces wait
    };
    // piece: what its next piece is expected to take.
    void setReady(uint64_t viewer, Ready ready, Seconds piece, TimePoint now);

    // A command has come in. Where commands come as evenly as frames, each would wait the same
    // share of an interval for its frame; the viewer's pace is moved so that frames begin just
    // after them, an eighth of an interval at a time and by a whole one a second at most (61 frames
    // instead of 60).
    void onInput(uint64_t viewer, TimePoint now);

    // Whose piece is to begin now; none when all are idle or not due, or it is better to wait.
    [[nodiscard]] std::optional<uint64_t> next(TimePoint now);
    // When next() may name a viewer that it did not name; may be past.
    [[nodiscard]] std::optional<TimePoint> nextDue() const;

    // The device now works for this viewer.
    void onStarted(uint64_t viewer);
    // On a new frame, which counts for its pace.
    void onFrame(uint64_t viewer, TimePoint now);
    // Device time that this viewer took, or is about to take.
    void charge(uint64_t viewer, Seconds cost);
    // The device has ended a piece, which took this much longer than was charged for it; negative:
    // less.
    void onFinished(uint64_t viewer, Seconds difference, TimePoint now);
    // The device had nothing to do for so long, since next() named nobody.
    void onIdle(Seconds time);

    // With viewers or in debt.
    [[nodiscard]] size_t accountCount() const { return accounts_.size(); }

  private:
    struct Share {
        Seconds virtual_time{0};
        Seconds virtual_now{0}; // of its viewers
        Seconds left_behind{0}; // the virtual time of a viewer that left in debt
        uint32_t viewer_count = 0;
        bool ready = false; // one of its viewers
        TimePoint due{};    // the first of those
    };
    using Accounts = std::map<session::Account, Share>;
    struct Entry {
        Accounts::iterator account;
        bool beside = false;
        Ready ready = Ready::kNo;
        TimePoint ready_since{};
        Seconds piece{0};
        Seconds virtual_time{0};
        bool was_ready = false; // and due, when next() last looked
        TimePoint due{};        // the grid of an even pace; a viewer that kept up stays on it
        Seconds movable{0};     // how much earlier it may yet become,
        TimePoint counted{};    // as of then
        // How long it usually takes to be ready again after a piece of its own.
        Seconds gap{0};
        std::optional<TimePoint> served_at;  // none: never
        uint64_t begun_then = 0;             // as begun_count_
        std::optional<TimePoint> held_until; // waits for others

        [[nodiscard]] TimePoint readyAt() const {
            return ready == Ready::kPiece ? TimePoint{} : due;
        }
        [[nodiscard]] bool isReady(TimePoint now) const {
            return ready != Ready::kNo && readyAt() <= now;
        }
    };

    [[nodiscard]] Entry* find(uint64_t viewer);
    Entry& enter(uint64_t viewer, const session::Account& account);
    [[nodiscard]] double priceOf(const Entry& entry) const;
    void refresh(TimePoint now);
    void becomeReady(Entry& entry) const;
    // Whether `one` is to be served before `other`; both as if they were ready.
    [[nodiscard]] bool isBefore(const Entry& one, const Entry& other) const;
    // For whom this one's piece has to wait, where there is somebody.
    [[nodiscard]] Entry* heldFor(const Entry& entry, TimePoint now);
    void forget(Accounts::iterator account);

    const Seconds min_interval_;
    Seconds virtual_now_{0};
    Accounts accounts_;
    boost::container::flat_map<uint64_t, Entry> viewers_; // walked through for each piece
    uint64_t begun_count_ = 0;                            // pieces
    std::optional<uint64_t> idle_for_;                    // whom the idle device waits for
};

} // namespace froxel::stream

// Shares of the device between viewers of all kinds, in virtual time.
#include "stream/frame_scheduler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <limits>
#include <string>

namespace froxel::stream {
namespace {

using namespace std::chrono_literals;

const TimePoint kStart = TimePoint() + 1h;

Clock::duration ticks(Seconds time) {
    return std::chrono::duration_cast<Clock::duration>(time);
}

struct Client {
    std::string account;
    Seconds piece;            // that one takes
    uint32_t piece_count = 1; // of a frame
    Seconds pause{0};         // until it wants another one
    bool reconnects = false;  // for each frame
    double estimate = 1;      // of the truth; 0: unknown

    uint64_t id = 0;
    uint32_t waiting = 0; // pieces
    TimePoint wants_at = kStart;
    Seconds used{0};
    uint32_t frames = 0;
    TimePoint last_frame = kStart;
    Seconds longest_gap{0};
};

// A device that works for one piece after another, as the render loop gives them.
class Simulation {
  public:
    explicit Simulation(Seconds interval = 0s) : scheduler_(interval) {}

    Client& add(Client client) {
        client.wants_at = client.last_frame = now_;
        join(client);
        clients_.push_back(std::move(client));
        return clients_.back();
    }
    void run(Seconds time) {
        for (Client& client : clients_) {
            client.used = 0s;
            client.frames = 0;
            client.longest_gap = 0s;
        }
        for (const TimePoint end = now_ + ticks(time); now_ < end;) {
            step();
        }
    }
    [[nodiscard]] FrameScheduler& scheduler() { return scheduler_; }

  private:
    void join(Client& client) {
        client.id = ++last_id_;
        scheduler_.add(client.id, {client.account});
    }
    void step() {
        for (Client& client : clients_) {
            using Ready = FrameScheduler::Ready;
            const Ready ready = client.waiting > 0        ? Ready::kPiece
                                : client.wants_at <= now_ ? Ready::kFrame
                                                          : Ready::kNo;
            scheduler_.setReady(client.id, ready, client.piece, now_);
        }
        if (const auto id = scheduler_.next(now_)) {
            work(*std::find_if(clients_.begin(), clients_.end(),
                               [id](const Client& client) { return client.id == *id; }));
            return;
        }
        TimePoint until = scheduler_.nextDue().value_or(TimePoint::max());
        for (const Client& client : clients_) {
            if (client.waiting == 0 && client.wants_at > now_) {
                until = std::min(until, client.wants_at);
            }
        }
        scheduler_.onIdle(std::max(until, now_ + 1us) - now_);
        now_ = std::max(until, now_ + 1us);
    }
    void work(Client& client) {
        scheduler_.onStarted(client.id);
        if (client.waiting == 0) {
            scheduler_.onFrame(client.id, now_);
            client.waiting = client.piece_count;
        }
        const Seconds charged = client.piece * client.estimate;
        scheduler_.charge(client.id, charged);
        now_ += ticks(client.piece);
        scheduler_.onFinished(client.id, client.piece - charged, now_);
        client.used += client.piece;
        if (--client.waiting > 0 && !client.reconnects) {
            return;
        }
        client.waiting = 0;
        ++client.frames;
        client.longest_gap = std::max<Seconds>(client.longest_gap, now_ - client.last_frame);
        client.last_frame = now_;
        client.wants_at = now_ + ticks(client.pause);
        if (client.reconnects) {
            scheduler_.remove(client.id);
            join(client);
        }
    }

    FrameScheduler scheduler_;
    TimePoint now_ = kStart;
    uint64_t last_id_ = 0;
    std::deque<Client> clients_;
};

constexpr Seconds kRun{60};

// Alone, and then beside another one.
double partOfItsRate(const Client& honest, Client hostile, Seconds interval, Seconds* gap) {
    Simulation alone(interval);
    const Client& undisturbed = alone.add(honest);
    alone.run(kRun);
    Simulation both(interval);
    both.add(std::move(hostile));
    const Client& disturbed = both.add(honest);
    both.run(kRun);
    *gap = disturbed.longest_gap;
    return static_cast<double>(disturbed.frames) / undisturbed.frames;
}

TEST(FairShares, FrameOfASecondInPieces_OtherKeepsItsHalfAndSmallGaps) {
    Simulation simulation;
    simulation.add({"hostile", 250ms, 4});
    const Client& honest = simulation.add({"honest", 50ms});
    simulation.run(kRun);
    EXPECT_GE(honest.used / kRun, 0.45);
    EXPECT_LE(honest.longest_gap, 350ms);
}

TEST(FairShares, CostIsUnknownBeforehand_OtherKeepsItsHalf) {
    Simulation simulation;
    Client hostile{"hostile", 250ms, 4};
    hostile.estimate = 0;
    simulation.add(hostile);
    const Client& honest = simulation.add({"honest", 50ms});
    simulation.run(kRun);
    EXPECT_GE(honest.used / kRun, 0.45);
    EXPECT_LE(honest.longest_gap, 350ms);
}

TEST(FairShares, ReconnectsForEachFrame_GainsNothing) {
    for (const char* account : {"hostile", "honest"}) { // a token of its own, or a common one
        Simulation simulation;
        Client hostile{account, 250ms};
        hostile.reconnects = true;
        hostile.pause = 1ms;
        simulation.add(hostile);
        const Client& honest = simulation.add({"honest", 50ms});
        simulation.run(kRun);
        EXPECT_GE(honest.used / kRun, 0.45) << account;
        EXPECT_LE(honest.longest_gap, 350ms) << account;
    }
}

TEST(FairShares, EightSessionsOfOneAccount_HaveOneShare) {
    Simulation simulation;
    std::vector<const Client*> many;
    for (int i = 0; i < 8; ++i) {
        many.push_back(&simulation.add({"many", 50ms}));
    }
    const Client& one = simulation.add({"one", 50ms});
    simulation.run(kRun);
    EXPECT_NEAR(one.used / kRun, 0.5, 0.01);
    for (const Client* client : many) {
        EXPECT_NEAR(client->used / kRun, 0.5 / 8, 0.01);
    }
}

// A viewer that is not ready at once after a frame: by the pace of a screen, or because its link's
// credit comes back a little later.
TEST(FairShares, NeedsAMomentBetweenFrames_KeepsItsPartBesideLongPieces) {
    struct Case {
        Seconds frame, pause, interval;
    };
    for (const Case& at : {Case{10ms, 0ms, Seconds(1.0 / 60)}, Case{40ms, 15ms, 0ms},
                           Case{5ms, 60ms, 0ms}, Case{20ms, 120ms, 0ms}, Case{20ms, 200ms, 0ms}}) {
        Client honest{"honest", at.frame};
        honest.pause = at.pause;
        for (const bool reconnects : {false, true}) {
            Client hostile{"hostile", 250ms, 4};
            hostile.reconnects = reconnects;
            Seconds gap{0};
            EXPECT_GE(partOfItsRate(honest, hostile, at.interval, &gap), 0.4)
                << at.frame.count() << " " << at.pause.count() << " " << reconnects;
            EXPECT_LE(gap, 500ms);
        }
    }
}

// Nor does whoever is waited for gain by it.
TEST(FairShares, TinyFramesWithPauses_LeaveTheOtherItsHalf) {
    Simulation simulation;
    Client hostile{"hostile", 1ms};
    hostile.pause = 20ms;
    simulation.add(hostile);
    const Client& honest = simulation.add({"honest", 100ms});
    simulation.run(kRun);
    EXPECT_GE(honest.used / kRun, 0.45);
}

TEST(FairShares, CheapFramesForAMinute_AreNoCreditForDearOnes) {
    Simulation simulation(Seconds(1.0 / 60));
    Client& hostile = simulation.add({"hostile", 1ms});
    const Client& honest = simulation.add({"honest", 14ms});
    simulation.run(kRun);
    hostile.piece = 250ms;
    simulation.run(5s);
    EXPECT_GE(honest.used / 5s, 0.4);
    EXPECT_LE(honest.longest_gap, 350ms);
}

// A pair of frames at a time: nothing is left idle that anybody could use.
TEST(FairShares, ViewersThatNeedLittle_LeaveTheRest) {
    Simulation simulation(Seconds(1.0 / 60));
    for (const char* account : {"a", "b", "c"}) {
        simulation.add({account, 2ms});
    }
    const Client& dear = simulation.add({"dear", 12ms});
    simulation.run(kRun);
    EXPECT_GE(dear.used / kRun, 0.5);
}

TEST(FairShares, AccountsThatLeft_AreForgottenOnceTheirDebtIsOld) {
    Simulation simulation;
    FrameScheduler& scheduler = simulation.scheduler();
    for (uint64_t id = 1000; id < 2000; ++id) {
        scheduler.add(id, {std::to_string(id)});
        scheduler.onStarted(id);
        scheduler.charge(id, 100ms);
        scheduler.remove(id);
        (void)scheduler.next(kStart);
        scheduler.onIdle(10ms);
        ASSERT_LE(scheduler.accountCount(), 12U);
    }
    scheduler.onIdle(100ms);
    EXPECT_EQ(scheduler.accountCount(), 0U);
}

} // namespace
} // namespace froxel::stream

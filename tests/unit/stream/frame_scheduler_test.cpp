#include "stream/frame_scheduler.h"

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace froxel::stream {
namespace {

using namespace std::chrono_literals;
using Ready = FrameScheduler::Ready;

const TimePoint kStart = TimePoint() + 1h;

// With an account of its own.
void addAlone(FrameScheduler& scheduler, uint64_t viewer) {
    scheduler.add(viewer, {std::to_string(viewer)});
}
void setReady(FrameScheduler& scheduler, uint64_t viewer) {
    scheduler.setReady(viewer, Ready::kFrame, 0s, kStart);
}

TEST(FrameScheduler, Next_NobodyReady_IsNone) {
    FrameScheduler scheduler(0s);
    addAlone(scheduler, 1);
    EXPECT_FALSE(scheduler.next(kStart));
    EXPECT_FALSE(scheduler.nextDue());
}

TEST(FrameScheduler, Next_EqualCosts_TakesTurns) {
    FrameScheduler scheduler(0s);
    std::map<uint64_t, int> drawn;
    for (const uint64_t viewer : {1U, 2U, 3U}) {
        addAlone(scheduler, viewer);
        setReady(scheduler, viewer);
    }
    for (int i = 0; i < 30; ++i) {
        const uint64_t viewer = scheduler.next(kStart + i * 1ms).value();
        scheduler.onStarted(viewer);
        scheduler.onFrame(viewer, kStart + i * 1ms);
        scheduler.charge(viewer, 5ms);
        ++drawn[viewer];
    }
    EXPECT_EQ(drawn, (std::map<uint64_t, int>{{1, 10}, {2, 10}, {3, 10}}));
}

TEST(FrameScheduler, Next_OneViewerCostsTenTimesAsMuch_SharesTimeNotFrames) {
    FrameScheduler scheduler(0s);
    const std::map<uint64_t, Seconds> costs = {{1, 100ms}, {2, 10ms}};
    std::map<uint64_t, Seconds> used;
    for (const auto& [viewer, cost] : costs) {
        addAlone(scheduler, viewer);
        setReady(scheduler, viewer);
    }
    for (int i = 0; i < 220; ++i) {
        const uint64_t viewer = scheduler.next(kStart).value();
        scheduler.onStarted(viewer);
        scheduler.onFrame(viewer, kStart);
        scheduler.charge(viewer, costs.at(viewer));
        used[viewer] += costs.at(viewer);
    }
    EXPECT_NEAR(used[1].count(), used[2].count(), 0.2);
}

// By how many accounts ever: what is beside them gets a twentieth of the device while they want all
// of it, and all that they leave.
TEST(FrameScheduler, Beside_HasASmallShare_AndWhatIsLeft) {
    for (const uint64_t others : {1U, 5U, 30U}) {
        FrameScheduler scheduler(0s);
        for (uint64_t viewer = 1; viewer <= others; ++viewer) {
            addAlone(scheduler, viewer);
            setReady(scheduler, viewer);
        }
        for (const uint64_t viewer : {100U, 101U}) {
            scheduler.addBeside(viewer);
            setReady(scheduler, viewer);
        }
        std::map<bool, Seconds> used;
        for (int i = 0; i < 4000; ++i) {
            const uint64_t viewer = scheduler.next(kStart).value();
            scheduler.onStarted(viewer);
            scheduler.onFrame(viewer, kStart);
            scheduler.charge(viewer, 5ms);
            used[viewer >= 100] += 5ms;
        }
        EXPECT_NEAR(used[true] / (used[true] + used[false]), FrameScheduler::kBesideShare, 0.005)
            << others;
        for (uint64_t viewer = 1; viewer <= others; ++viewer) {
            scheduler.setReady(viewer, Ready::kNo, 0s, kStart);
        }
        EXPECT_GE(scheduler.next(kStart + 10s).value(), 100U);
    }
}

TEST(FrameScheduler, Next_ViewerWasIdle_GetsNoCreditForIt) {
    FrameScheduler scheduler(0s);
    addAlone(scheduler, 1);
    addAlone(scheduler, 2);
    setReady(scheduler, 1);
    for (int i = 0; i < 100; ++i) {
        scheduler.onStarted(1);
        scheduler.onFrame(1, kStart);
        scheduler.charge(1, 10ms);
    }
    setReady(scheduler, 2);
    int in_a_row = 0;
    while (scheduler.next(kStart) == 2U && in_a_row < 50) {
        scheduler.onStarted(2);
        scheduler.onFrame(2, kStart);
        scheduler.charge(2, 10ms);
        ++in_a_row;
    }
    EXPECT_LE(in_a_row, 2);
}

TEST(FrameScheduler, Next_WithinTheInterval_WaitsUntilDue) {
    FrameScheduler scheduler(10ms);
    addAlone(scheduler, 1);
    setReady(scheduler, 1);
    scheduler.onStarted(1);
    scheduler.onFrame(1, kStart);
    EXPECT_FALSE(scheduler.next(kStart + 9ms));
    ASSERT_EQ(scheduler.nextDue(), kStart + 10ms);
    EXPECT_EQ(scheduler.next(kStart + 10ms), 1U);
}

TEST(FrameScheduler, OnStarted_SlightlyLate_KeepsTheAveragePace) {
    FrameScheduler scheduler(10ms);
    addAlone(scheduler, 1);
    setReady(scheduler, 1);
    scheduler.onStarted(1);
    scheduler.onFrame(1, kStart);
    scheduler.onStarted(1);
    scheduler.onFrame(1, kStart + 13ms);
    EXPECT_EQ(scheduler.nextDue(), kStart + 20ms);
}

TEST(FrameScheduler, OnStarted_AfterALongPause_DoesNotCatchUp) {
    FrameScheduler scheduler(10ms);
    addAlone(scheduler, 1);
    setReady(scheduler, 1);
    scheduler.onStarted(1);
    scheduler.onFrame(1, kStart);
    scheduler.onStarted(1);
    scheduler.onFrame(1, kStart + 1s);
    EXPECT_EQ(scheduler.nextDue(), kStart + 1s + 10ms);
}

// Frames that start when due, of a viewer whose picture always moves.
struct Played {
    uint32_t frames = 0;
    Seconds last_wait{0}; // of the last command for its frame
};
Played play(FrameScheduler& scheduler, const std::vector<TimePoint>& commands, TimePoint end) {
    Played played;
    std::optional<TimePoint> waiting;
    auto command = commands.begin();
    for (TimePoint now = kStart; now < end; now += 50us) {
        if (command != commands.end() && *command <= now) {
            scheduler.onInput(1, *command);
            waiting = waiting.value_or(*command);
            ++command;
        }
        if (scheduler.next(now)) {
            scheduler.onStarted(1);
            scheduler.onFrame(1, now);
            ++played.frames;
            if (waiting) {
                played.last_wait = now - *waiting;
                waiting.reset();
            }
        }
    }
    return played;
}

TEST(FrameScheduler, OnInput_CommandsAsEvenAsFrames_SoonWaitLittle) {
    const auto interval = std::chrono::duration_cast<Clock::duration>(Seconds(1.0 / 60));
    for (const auto offset : {1ms, 6ms, 12ms, 16ms}) {
        FrameScheduler scheduler(interval);
        addAlone(scheduler, 1);
        setReady(scheduler, 1);
        std::vector<TimePoint> commands;
        for (int i = 0; i < 60; ++i) {
            commands.push_back(kStart + offset + i * interval);
        }
        const auto played = play(scheduler, commands, kStart + 1s);
        EXPECT_LE(played.last_wait, 2500us) << offset.count();
        EXPECT_LE(played.frames, 62U);
    }
}

TEST(FrameScheduler, OnInput_AFloodOfCommands_AddsAFrameASecondAtMost) {
    FrameScheduler scheduler(10ms);
    addAlone(scheduler, 1);
    setReady(scheduler, 1);
    std::mt19937 random(7);
    std::vector<TimePoint> commands{kStart};
    while (commands.back() < kStart + 10s) {
        commands.push_back(commands.back() + std::chrono::microseconds(random() % 8000));
    }
    EXPECT_LE(play(scheduler, commands, kStart + 10s).frames, 1000U + 12U);
}

TEST(FrameScheduler, OnInput_AnUnknownViewerOrNothingDue_ChangesNothing) {
    FrameScheduler scheduler(10ms);
    scheduler.onInput(7, kStart);
    addAlone(scheduler, 1);
    setReady(scheduler, 1);
    scheduler.onInput(1, kStart);
    EXPECT_EQ(scheduler.next(kStart), 1U);
}

TEST(FrameScheduler, Remove_ReadyViewer_IsNeverNamedAgain) {
    FrameScheduler scheduler(0s);
    addAlone(scheduler, 1);
    setReady(scheduler, 1);
    scheduler.remove(1);
    setReady(scheduler, 1);
    scheduler.charge(1, 1s);
    EXPECT_FALSE(scheduler.next(kStart));
}

// A device that serves one frame after another, for a while: how often each viewer was drawn.
struct Simulated {
    Seconds cost; // ready again as soon as its frame is done
};
std::map<uint64_t, double> ratesOf(const std::vector<Simulated>& viewers, Seconds interval) {
    FrameScheduler scheduler(interval);
    std::map<uint64_t, double> drawn;
    for (uint64_t id = 0; id < viewers.size(); ++id) {
        addAlone(scheduler, id);
        setReady(scheduler, id);
        drawn[id] = 0;
    }
    constexpr double kSeconds = 60;
    const TimePoint end = kStart + 60s;
    for (TimePoint now = kStart; now < end;) {
        const auto id = scheduler.next(now);
        if (!id) {
            now = std::max(now + 1us, scheduler.nextDue().value());
            continue;
        }
        scheduler.onStarted(*id);
        scheduler.onFrame(*id, now);
        now += std::chrono::duration_cast<Clock::duration>(viewers[*id].cost);
        scheduler.charge(*id, viewers[*id].cost);
        drawn[*id] += 1 / kSeconds;
    }
    return drawn;
}

// Sixty times a second at 1 ms is a third of the device for five of them; the two that ask for
// more than their share divide the rest.
TEST(FrameScheduler, MixedCosts_CheapViewersKeepTheirRate_DearOnesShareTheRest) {
    std::vector<Simulated> viewers(5, {1ms});
    viewers.push_back({50ms});
    viewers.push_back({20ms});
    const auto rates = ratesOf(viewers, Seconds(1.0 / 60));
    const double left = 1 - 5 * 60 * 0.001;
    for (uint64_t id = 0; id < 5; ++id) {
        // A frame under way is never cut off: the next one waits for as long as the dearest takes.
        EXPECT_GT(rates.at(id), 1 / (0.050 + 0.020 + 5 * 0.001)) << id;
    }
    EXPECT_GT(rates.at(5) * 0.050, left / 2 * 0.9);
    EXPECT_GT(rates.at(6) * 0.020, left / 2 * 0.9);
    EXPECT_NEAR(rates.at(5) * 0.050, rates.at(6) * 0.020, 0.05);
}

// More asked for than there is: whatever the costs, each has the same part of the device's time.
TEST(FrameScheduler, MixedCosts_AllWantMore_ShareTimeEqually) {
    std::mt19937 random(3);
    for (int run = 0; run < 10; ++run) {
        std::vector<Simulated> viewers;
        for (int i = 0; i < 8; ++i) {
            viewers.push_back({Seconds(std::uniform_real_distribution<double>(0.02, 0.1)(random))});
        }
        const auto rates = ratesOf(viewers, 0s);
        for (uint64_t id = 0; id < viewers.size(); ++id) {
            EXPECT_NEAR(rates.at(id) * viewers[id].cost.count(), 1.0 / 8, 0.005) << id;
        }
    }
}

// One that comes later neither starves nor is starved.
TEST(FrameScheduler, MixedCosts_OneComesLate_GetsItsShareAndNoMore) {
    FrameScheduler scheduler(0s);
    std::map<uint64_t, Seconds> costs = {{1, 30ms}, {2, 5ms}};
    std::map<uint64_t, Seconds> used;
    const auto add = [&](uint64_t id) {
        addAlone(scheduler, id);
        setReady(scheduler, id);
    };
    const auto draw = [&](Seconds time) {
        used.clear();
        for (Seconds now{0}; now < time;) {
            const uint64_t id = scheduler.next(kStart).value();
            scheduler.onStarted(id);
            scheduler.onFrame(id, kStart);
            scheduler.charge(id, costs.at(id));
            used[id] += costs.at(id);
            now += costs.at(id);
        }
    };
    add(1);
    add(2);
    draw(30s);
    costs[3] = 11ms;
    add(3);
    draw(30s);
    for (const auto& [id, time] : used) {
        EXPECT_NEAR(time.count(), 10, 0.1) << id;
    }
}

} // namespace
} // namespace froxel::stream

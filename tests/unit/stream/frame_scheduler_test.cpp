#include "stream/frame_scheduler.h"

#include <gtest/gtest.h>

#include <map>

namespace froxel::stream {
namespace {

using namespace std::chrono_literals;

const TimePoint kStart = TimePoint() + 1h;

TEST(FrameScheduler, Next_NobodyReady_IsNone) {
    FrameScheduler scheduler(0s);
    scheduler.add(1);
    EXPECT_FALSE(scheduler.next(kStart));
    EXPECT_FALSE(scheduler.nextDue());
}

TEST(FrameScheduler, Next_EqualCosts_TakesTurns) {
    FrameScheduler scheduler(0s);
    std::map<uint64_t, int> drawn;
    for (const uint64_t viewer : {1U, 2U, 3U}) {
        scheduler.add(viewer);
        scheduler.setReady(viewer, true);
    }
    for (int i = 0; i < 30; ++i) {
        const uint64_t viewer = scheduler.next(kStart + i * 1ms).value();
        scheduler.onStarted(viewer, kStart + i * 1ms);
        scheduler.onFinished(viewer, 5ms);
        ++drawn[viewer];
    }
    EXPECT_EQ(drawn, (std::map<uint64_t, int>{{1, 10}, {2, 10}, {3, 10}}));
}

TEST(FrameScheduler, Next_OneViewerCostsTenTimesAsMuch_SharesTimeNotFrames) {
    FrameScheduler scheduler(0s);
    const std::map<uint64_t, Seconds> costs = {{1, 100ms}, {2, 10ms}};
    std::map<uint64_t, Seconds> used;
    for (const auto& [viewer, cost] : costs) {
        scheduler.add(viewer);
        scheduler.setReady(viewer, true);
    }
    for (int i = 0; i < 220; ++i) {
        const uint64_t viewer = scheduler.next(kStart).value();
        scheduler.onStarted(viewer, kStart);
        scheduler.onFinished(viewer, costs.at(viewer));
        used[viewer] += costs.at(viewer);
    }
    EXPECT_NEAR(used[1].count(), used[2].count(), 0.2);
}

TEST(FrameScheduler, Next_ViewerWasIdle_GetsNoCreditForIt) {
    FrameScheduler scheduler(0s);
    scheduler.add(1);
    scheduler.add(2);
    scheduler.setReady(1, true);
    for (int i = 0; i < 100; ++i) {
        scheduler.onStarted(1, kStart);
        scheduler.onFinished(1, 10ms);
    }
    scheduler.setReady(2, true);
    int in_a_row = 0;
    while (scheduler.next(kStart) == 2U && in_a_row < 50) {
        scheduler.onStarted(2, kStart);
        scheduler.onFinished(2, 10ms);
        ++in_a_row;
    }
    EXPECT_LE(in_a_row, 2);
}

TEST(FrameScheduler, Next_WithinTheInterval_WaitsUntilDue) {
    FrameScheduler scheduler(10ms);
    scheduler.add(1);
    scheduler.setReady(1, true);
    scheduler.onStarted(1, kStart);
    EXPECT_FALSE(scheduler.next(kStart + 9ms));
    ASSERT_EQ(scheduler.nextDue(), kStart + 10ms);
    EXPECT_EQ(scheduler.next(kStart + 10ms), 1U);
}

TEST(FrameScheduler, OnStarted_SlightlyLate_KeepsTheAveragePace) {
    FrameScheduler scheduler(10ms);
    scheduler.add(1);
    scheduler.setReady(1, true);
    scheduler.onStarted(1, kStart);
    scheduler.onStarted(1, kStart + 13ms);
    EXPECT_EQ(scheduler.nextDue(), kStart + 20ms);
}

TEST(FrameScheduler, OnStarted_AfterALongPause_DoesNotCatchUp) {
    FrameScheduler scheduler(10ms);
    scheduler.add(1);
    scheduler.setReady(1, true);
    scheduler.onStarted(1, kStart);
    scheduler.onStarted(1, kStart + 1s);
    EXPECT_EQ(scheduler.nextDue(), kStart + 1s + 10ms);
}

TEST(FrameScheduler, Remove_ReadyViewer_IsNeverNamedAgain) {
    FrameScheduler scheduler(0s);
    scheduler.add(1);
    scheduler.setReady(1, true);
    scheduler.remove(1);
    scheduler.setReady(1, true);
    scheduler.onFinished(1, 1s);
    EXPECT_FALSE(scheduler.next(kStart));
}

} // namespace
} // namespace froxel::stream

// Where clips stand.
#include "motion/clip_clock.h"

#include <gtest/gtest.h>

#include <limits>

namespace froxel::motion {
namespace {

TEST(ClipClock, Loop_BeginsAnew) {
    const ClipClock clock;
    EXPECT_EQ(clock.timeAt(0, 2), 0);
    EXPECT_EQ(clock.timeAt(1.5, 2), 1.5);
    EXPECT_EQ(clock.timeAt(2, 2), 0);
    EXPECT_EQ(clock.timeAt(7.25, 2), 1.25);
    EXPECT_EQ(clock.timeAt(-0.5, 2), 1.5);
    EXPECT_EQ(clock.timeAt(-1e-300, 2), 0); // below 2 whatever rounds
}

TEST(ClipClock, PingPong_GoesThereAndBack) {
    const ClipClock clock{.repeat = Repeat::kPingPong};
    EXPECT_EQ(clock.timeAt(1.5, 2), 1.5);
    EXPECT_EQ(clock.timeAt(2, 2), 2);
    EXPECT_EQ(clock.timeAt(2.5, 2), 1.5);
    EXPECT_EQ(clock.timeAt(4, 2), 0);
    EXPECT_EQ(clock.timeAt(-0.5, 2), 0.5);
}

TEST(ClipClock, Once_StaysAtItsEnds) {
    const ClipClock clock{.repeat = Repeat::kOnce};
    EXPECT_EQ(clock.timeAt(-1, 2), 0);
    EXPECT_EQ(clock.timeAt(1, 2), 1);
    EXPECT_EQ(clock.timeAt(100, 2), 2);
}

TEST(ClipClock, SpeedAndSeek_MoveOnlyTheAnchor) {
    const ClipClock paused = ClipClock().withSpeed(3, 0);
    EXPECT_EQ(paused.timeAt(1000, 10), 3);
    const ClipClock back = paused.withSpeed(1000, -2);
    EXPECT_EQ(back.timeAt(1001, 10), 1);
    EXPECT_EQ(back.withPhase(1001, 8).timeAt(1001, 10), 8);
    EXPECT_EQ(back.withPhase(1001, 8).timeAt(1002, 10), 6);
}

TEST(ClipClock, NothingToPlay_StaysAtZero) {
    EXPECT_EQ(ClipClock().timeAt(5, 0), 0);
    EXPECT_EQ(ClipClock{.phase_s = std::numeric_limits<double>::infinity()}.timeAt(5, 2), 0);
    EXPECT_EQ(ClipClock{.phase_s = std::numeric_limits<double>::quiet_NaN()}.timeAt(5, 2), 0);
}

TEST(Fade, Weight_IsSmoothAndSumsToOne) {
    const Fade in{.start_s = 10, .duration_s = 4};
    const Fade out{.start_s = 10, .duration_s = 4, .out = true};
    EXPECT_EQ(in.weightAt(9), 0);
    EXPECT_EQ(in.weightAt(12), 0.5);
    EXPECT_EQ(in.weightAt(14), 1);
    EXPECT_EQ(in.weightAt(11), 0.15625); // 3/16 - 2/64
    EXPECT_EQ(out.weightAt(11), 1 - 0.15625);
    EXPECT_EQ(Fade().weightAt(-5), 1);
}

} // namespace
} // namespace froxel::motion

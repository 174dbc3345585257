// Where clips stand.
#include "motion/clip_clock.h"

#include <gtest/gtest.h>

#include <cmath>
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

// fmod is exact: whole turns leave no trace, however many.
TEST(ClipClock, Anchored_IsTheSameByTheLeastPhase) {
    const double duration_s = 1.1;
    const double turns = 1e6 * duration_s; // rounded once
    const ClipClock clock{.anchor_s = 5, .phase_s = turns};
    const double expected = std::fma(-999999.0, duration_s, turns); // exact, being representable
    EXPECT_EQ(clock.anchoredAt(5, duration_s).phase_s, std::fmod(expected, duration_s));
    EXPECT_EQ(clock.anchoredAt(5, duration_s).timeAt(5, duration_s), clock.timeAt(5, duration_s));
    const ClipClock back{.phase_s = 7, .speed = -1, .repeat = Repeat::kPingPong};
    EXPECT_EQ(back.anchoredAt(0, 2).phase_s, 3) << "it is on its way back";
    const ClipClock once{.phase_s = 9, .repeat = Repeat::kOnce};
    EXPECT_EQ(once.anchoredAt(0, 2).phase_s, 2) << "it has been at its end";
}

TEST(ClipClock, Rests_WhereItsTimeNeverChanges) {
    EXPECT_FALSE(ClipClock().restsAt(0, 2));
    EXPECT_TRUE(ClipClock().restsAt(0, 0));
    EXPECT_TRUE(ClipClock{.speed = 0}.restsAt(0, 2));
    const ClipClock once{.repeat = Repeat::kOnce};
    EXPECT_FALSE(once.restsAt(1.75, 2));
    EXPECT_TRUE(once.restsAt(2, 2));
    const ClipClock back{.phase_s = 2, .speed = -1, .repeat = Repeat::kOnce};
    EXPECT_FALSE(back.restsAt(1.75, 2));
    EXPECT_TRUE(back.restsAt(2, 2));
}

TEST(ClipClock, NothingToPlay_StaysAtZero) {
    EXPECT_EQ(ClipClock().timeAt(5, 0), 0);
    EXPECT_EQ(ClipClock{.phase_s = std::numeric_limits<double>::infinity()}.timeAt(5, 2), 0);
    EXPECT_EQ(ClipClock{.phase_s = std::numeric_limits<double>::quiet_NaN()}.timeAt(5, 2), 0);
}

TEST(Fade, Weight_IsSmooth) {
    const Fade in{.start_s = 10, .duration_s = 4};
    EXPECT_EQ(in.weightAt(9), 0);
    EXPECT_EQ(in.weightAt(12), 0.5);
    EXPECT_EQ(in.weightAt(14), 1);
    EXPECT_EQ(in.weightAt(11), 0.15625); // 3/16 - 2/64
    EXPECT_EQ(Fade().weightAt(-5), 1);
    EXPECT_FALSE(in.isOverAt(13.75));
    EXPECT_TRUE(in.isOverAt(14));
    EXPECT_TRUE(Fade().isOverAt(-5));
}

} // namespace
} // namespace froxel::motion

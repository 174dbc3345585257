#include "session/light_clock.h"

#include <gtest/gtest.h>

namespace froxel::session {
namespace {

using namespace std::chrono_literals;

constexpr TimePoint kStart{100s};

TEST(LightClock, Running_FollowsTheHostAtItsSpeed) {
    const LightClock clock(kStart, 2.5, true);
    EXPECT_TRUE(clock.moving());
    EXPECT_DOUBLE_EQ(clock.secondsAt(kStart), 0);
    EXPECT_DOUBLE_EQ(clock.secondsAt(kStart + 4s), 10);
    EXPECT_DOUBLE_EQ(clock.secondsAt(kStart + 4s), 10); // reading changes nothing
}

TEST(LightClock, Paused_StandsStill) {
    const LightClock clock = LightClock(kStart, 1, true).withRate(kStart + 3s, 1, false);
    EXPECT_FALSE(clock.moving());
    EXPECT_DOUBLE_EQ(clock.secondsAt(kStart + 3s), 3);
    EXPECT_DOUBLE_EQ(clock.secondsAt(kStart + 1000s), 3);
}

TEST(LightClock, ResumeAndSpeedChanges_NeverJump) {
    LightClock clock(kStart, 1, true);
    TimePoint now = kStart;
    for (const auto& [speed, running] :
         {std::pair{1.0, false}, {3.0, false}, {3.0, true}, {0.0, true}, {100.0, true}}) {
        now += 7s;
        const double before = clock.secondsAt(now);
        clock = clock.withRate(now, speed, running);
        EXPECT_EQ(clock.secondsAt(now), before);
    }
    EXPECT_DOUBLE_EQ(clock.secondsAt(now), 7 + 7 * 3);
    EXPECT_DOUBLE_EQ(clock.secondsAt(now + 1s), 28 + 100);
}

TEST(LightClock, SpeedZero_IsNotMoving) {
    EXPECT_FALSE(LightClock(kStart, 0, true).moving());
}

} // namespace
} // namespace froxel::session

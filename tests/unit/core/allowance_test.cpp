#include "core/allowance.h"

#include <gtest/gtest.h>

namespace froxel {
namespace {

using namespace std::chrono_literals;

TEST(Allowance, AtOnce_ThenByTheSecond) {
    Allowance allowance(3, 2);
    const TimePoint now = TimePoint() + 1h;
    EXPECT_EQ(allowance.nextAt(now), now);
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(allowance.take(now));
    }
    EXPECT_FALSE(allowance.take(now));
    EXPECT_EQ(allowance.nextAt(now), now + 500ms);
    EXPECT_FALSE(allowance.take(now + 499ms));
    EXPECT_TRUE(allowance.take(now + 500ms));
    EXPECT_FALSE(allowance.take(now + 500ms));
}

TEST(Allowance, LongRest_SavesNoMoreThanAtOnce) {
    Allowance allowance(2, 10);
    TimePoint now = TimePoint() + 1h;
    EXPECT_TRUE(allowance.take(now));
    now += 1h;
    EXPECT_TRUE(allowance.take(now));
    EXPECT_TRUE(allowance.take(now));
    EXPECT_FALSE(allowance.take(now));
    EXPECT_FALSE(allowance.take(now - 1h)) << "a time before the last gives nothing";
}

TEST(Allowance, Flood_GetsTheRateAndNoMore) {
    Allowance allowance(16, 5);
    int taken = 0;
    for (TimePoint now = TimePoint() + 1h; now < TimePoint() + 1h + 10s; now += 1ms) {
        taken += allowance.take(now) ? 1 : 0;
    }
    EXPECT_GE(taken, 16 + 49);
    EXPECT_LE(taken, 16 + 50);
}

} // namespace
} // namespace froxel

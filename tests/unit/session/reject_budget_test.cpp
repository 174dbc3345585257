#include "session/reject_budget.h"

#include <gtest/gtest.h>

namespace froxel::session {
namespace {

using namespace std::chrono_literals;

TEST(RejectBudget, TheTwentyFirstWithinTenSeconds_IsTooMany) {
    RejectBudget budget;
    const TimePoint start{1s};
    for (int i = 0; i < 20; ++i) {
        EXPECT_TRUE(budget.spend(start + i * 400ms)) << i;
    }
    EXPECT_FALSE(budget.spend(start + 9999ms));
}

TEST(RejectBudget, OldOnes_AreForgiven) {
    RejectBudget budget;
    TimePoint now{1s};
    for (int i = 0; i < 200; ++i) {
        EXPECT_TRUE(budget.spend(now)) << i;
        now += 501ms;
    }
}

TEST(RejectBudget, Recovers_AfterAQuietPeriod) {
    RejectBudget budget;
    const TimePoint start{1s};
    for (int i = 0; i < 25; ++i) {
        static_cast<void>(budget.spend(start));
    }
    EXPECT_FALSE(budget.spend(start + 1s));
    EXPECT_TRUE(budget.spend(start + 11s));
}

} // namespace
} // namespace froxel::session

#include "render/light_budget.h"

#include <gtest/gtest.h>

namespace froxel::render {
namespace {

TEST(LightBudget, WhatFinishesInTime_IsTaken) {
    EXPECT_TRUE(checkLightBudget({640, 360}, 0, true));
    EXPECT_TRUE(checkLightBudget({640, 360}, 20'000, true));
    EXPECT_TRUE(checkLightBudget({1920, 1080}, 200'000, false));
    EXPECT_TRUE(checkLightBudget({3000, 2000}, 1000, true)); // the limit itself
}

TEST(LightBudget, WhatWouldTakeMinutes_IsRefusedWithTheNumbers) {
    const auto refused = checkLightBudget({640, 360}, 1'000'000, true);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kCapacity);
    EXPECT_EQ(refused.error().message,
              "a picture of 640x360 whose pixels loop over 1000000 lights each takes 2.3e+11 "
              "evaluations of lights; this device draws at most 6.0e+09 a frame: ask for fewer or "
              "smaller lights, lists, or a smaller picture");
    EXPECT_FALSE(checkLightBudget({1920, 1080}, 1'000'000, false));
    EXPECT_FALSE(checkLightBudget({3000, 2000}, 1001, true));
}

} // namespace
} // namespace froxel::render

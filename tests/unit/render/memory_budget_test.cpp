#include "render/device/memory_budget.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace froxel::render {
namespace {

constexpr uint64_t kMib = 1 << 20U;

TEST(MemoryBudget, WithoutLimits_EverythingFits) {
    MemoryBudget budget;
    MemoryShare share(budget);
    EXPECT_TRUE(share.take({.device_bytes = uint64_t{1} << 60U}, "a picture"));
}

TEST(MemoryBudget, Shares_AddUpWithTheScene) {
    MemoryBudget budget({.device_bytes = 100 * kMib, .session_bytes = 60 * kMib});
    SceneMemory scene(budget);
    scene.add(30 * kMib);
    MemoryShare a(budget);
    MemoryShare b(budget);
    ASSERT_TRUE(a.take({.device_bytes = 40 * kMib}, "a picture"));
    const auto refused = b.take({.device_bytes = 40 * kMib}, "a picture of 640x360");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kCapacity);
    EXPECT_THAT(refused.error().message,
                testing::HasSubstr("a picture of 640x360 takes 41 MiB of memory; scenes and "
                                   "other sessions use 71 of the device's 100"));
    EXPECT_TRUE(b.take({.device_bytes = 30 * kMib}, "a picture"));
    EXPECT_EQ(budget.takenBytes(), 100 * kMib);
}

TEST(MemoryBudget, WhatASceneTakesLater_IsAskedFor) {
    MemoryBudget budget({.device_bytes = 100 * kMib});
    SceneMemory scene(budget);
    scene.add(30 * kMib);
    MemoryShare view(budget);
    ASSERT_TRUE(view.take({.device_bytes = 40 * kMib}, "a picture"));
    const auto refused = scene.take(31 * kMib, "light");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kCapacity);
    EXPECT_THAT(refused.error().message, testing::HasSubstr("light takes 32 MiB of memory"));
    EXPECT_EQ(budget.takenBytes(), 70 * kMib);
    EXPECT_TRUE(scene.take(30 * kMib, "light"));
    EXPECT_EQ(budget.takenBytes(), 100 * kMib);
}

TEST(MemoryBudget, RefusedTake_KeepsWhatWasTaken) {
    MemoryBudget budget({.session_bytes = 10 * kMib});
    MemoryShare share(budget);
    ASSERT_TRUE(share.take({.device_bytes = 8 * kMib}, "a picture"));
    EXPECT_FALSE(share.take({.device_bytes = 11 * kMib}, "a picture"));
    EXPECT_EQ(budget.takenBytes(), 8 * kMib);
}

TEST(MemoryBudget, NextTake_ReplacesTheOneBefore) {
    MemoryBudget budget({.device_bytes = 10 * kMib});
    MemoryShare share(budget);
    ASSERT_TRUE(share.take({.device_bytes = 8 * kMib}, "a picture"));
    EXPECT_TRUE(share.take({.device_bytes = 10 * kMib}, "a picture"));
    EXPECT_EQ(budget.takenBytes(), 10 * kMib);
}

TEST(MemoryBudget, ShareThatGoes_GivesBack) {
    MemoryBudget budget;
    {
        MemoryShare share(budget);
        ASSERT_TRUE(share.take({.device_bytes = 8 * kMib}, "a picture"));
    }
    EXPECT_EQ(budget.takenBytes(), 0U);
}

TEST(MemoryBudget, SceneThatGoes_GivesBack) {
    MemoryBudget budget({.device_bytes = 100 * kMib});
    SceneMemory stays(budget);
    stays.add(10 * kMib);
    {
        SceneMemory goes(budget);
        goes.add(30 * kMib);
        ASSERT_TRUE(goes.take(50 * kMib, "light"));
        EXPECT_EQ(goes.bytes(), 80 * kMib);
        EXPECT_FALSE(stays.take(20 * kMib, "light"));
    }
    EXPECT_EQ(budget.takenBytes(), 10 * kMib);
    EXPECT_TRUE(stays.take(20 * kMib, "light"));
}

TEST(MemoryBudget, HostsPart_HasALimitOfItsOwn) {
    MemoryBudget budget({.device_bytes = 100 * kMib, .host_bytes = 20 * kMib});
    SceneMemory scene(budget);
    scene.add(90 * kMib); // the device's
    MemoryShare a(budget);
    MemoryShare b(budget);
    ASSERT_TRUE(a.take({.device_bytes = 2 * kMib, .host_bytes = 15 * kMib}, "a picture"));
    const auto refused = b.take({.device_bytes = 2 * kMib, .host_bytes = 6 * kMib}, "a picture");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, testing::HasSubstr("of the host's 20"));
    EXPECT_TRUE(b.take({.device_bytes = 2 * kMib, .host_bytes = 5 * kMib}, "a picture"));
}

} // namespace
} // namespace froxel::render

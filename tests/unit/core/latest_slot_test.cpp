#include "core/latest_slot.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

namespace froxel {
namespace {

TEST(LatestSlot, Put_OverAnUntakenValue_ReplacesIt) {
    LatestSlot<int> slot;
    EXPECT_FALSE(slot.full());
    EXPECT_FALSE(slot.put(1));
    EXPECT_TRUE(slot.put(2));
    EXPECT_TRUE(slot.full());
    EXPECT_EQ(slot.take(), 2);
    EXPECT_FALSE(slot.full());
    EXPECT_EQ(slot.take(), std::nullopt);
}

TEST(LatestSlot, MoveOnlyValues_PassThrough) {
    LatestSlot<std::unique_ptr<int>> slot;
    slot.put(std::make_unique<int>(7));
    const auto taken = slot.take();
    ASSERT_TRUE(taken);
    EXPECT_EQ(**taken, 7);
}

TEST(LatestSlot, TwoThreads_ReaderSeesAscendingValuesAndTheLast) {
    constexpr int kLast = 20'000;
    LatestSlot<int> slot;
    std::thread writer([&] {
        for (int i = 1; i <= kLast; ++i) {
            slot.put(i);
        }
    });
    int seen = 0;
    while (seen != kLast) {
        if (const auto value = slot.take()) {
            ASSERT_GT(*value, seen);
            seen = *value;
        }
    }
    writer.join();
}

} // namespace
} // namespace froxel

#include "still/still_store.h"

#include <gtest/gtest.h>

#include <string>

namespace froxel::still {
namespace {

SharedBytes bytesOf(size_t count) {
    return std::make_shared<const std::vector<std::byte>>(count);
}

TEST(StillStore, WhatWasAskedForLongestAgo_GoesFirst) {
    StillStore store(100);
    for (const char* tag : {"a", "b", "c", "d"}) {
        store.keep(tag, bytesOf(25));
    }
    EXPECT_TRUE(store.find("a"));
    store.keep("e", bytesOf(20));
    EXPECT_TRUE(store.find("a")) << "it was asked for again";
    EXPECT_FALSE(store.find("b"));
    EXPECT_EQ(store.bytes(), 95U);
}

TEST(StillStore, SameTag_TakesThePlaceOfTheOneBefore) {
    StillStore store(100);
    store.keep("a", bytesOf(25));
    store.keep("a", bytesOf(10));
    EXPECT_EQ(store.find("a")->size(), 10U);
    EXPECT_EQ(store.bytes(), 10U);
}

TEST(StillStore, LargeOne_DoesNotDriveTheOthersOut) {
    StillStore store(100);
    store.keep("a", bytesOf(25));
    store.keep("large", bytesOf(26));
    EXPECT_FALSE(store.find("large"));
    EXPECT_TRUE(store.find("a"));
}

} // namespace
} // namespace froxel::still

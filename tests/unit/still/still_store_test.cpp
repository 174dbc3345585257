#include "still/still_store.h"

#include <gtest/gtest.h>

#include <string>

namespace froxel::still {
namespace {

SharedBytes bytesOf(size_t count) {
    return std::make_shared<const std::vector<std::byte>>(count);
}

const uint64_t kOne = StillStore::weightOf("a", bytesOf(1000));

TEST(StillStore, WhatWasAskedForLongestAgo_GoesFirst) {
    StillStore store(4 * kOne);
    for (const char* tag : {"a", "b", "c", "d"}) {
        store.keep(tag, bytesOf(1000));
    }
    EXPECT_TRUE(store.find("a"));
    store.keep("e", bytesOf(900));
    EXPECT_TRUE(store.find("a")) << "it was asked for again";
    EXPECT_FALSE(store.find("b"));
    EXPECT_EQ(store.bytes(), 4 * kOne - 100);
}

TEST(StillStore, SameTag_TakesThePlaceOfTheOneBefore) {
    StillStore store(4 * kOne);
    store.keep("a", bytesOf(1000));
    store.keep("a", bytesOf(10));
    EXPECT_EQ(store.find("a")->size(), 10U);
    EXPECT_EQ(store.bytes(), kOne - 990);
}

TEST(StillStore, LargeOne_DoesNotDriveTheOthersOut) {
    StillStore store(4 * kOne);
    store.keep("a", bytesOf(1000));
    store.keep("b", bytesOf(1001));
    EXPECT_FALSE(store.find("b"));
    EXPECT_TRUE(store.find("a"));
}

// A request's header has up to 8 kB, of which a picture of 16x16 has less.
TEST(StillStore, LongTags_CountToo) {
    const auto tag = [](int number) {
        std::string text(8000, 'x');
        text.append(std::to_string(number));
        return text;
    };
    StillStore store(100'000);
    for (int i = 0; i < 100; ++i) {
        store.keep(tag(i), bytesOf(1));
    }
    EXPECT_LE(store.bytes(), 100'000U);
    EXPECT_FALSE(store.find(tag(0)));
    EXPECT_TRUE(store.find(tag(99)));
}

} // namespace
} // namespace froxel::still

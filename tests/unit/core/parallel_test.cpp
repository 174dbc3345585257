#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace froxel {
namespace {

TEST(Parallel, EveryThingIsInOneRange) {
    for (const size_t count : {0U, 1U, 7U, 1000U}) {
        for (const size_t threads : {1U, 3U, 16U}) {
            std::vector<std::atomic<int>> visits(count);
            std::vector<std::atomic<int>> ranges(threads);
            onThreads(count, threads, [&](size_t thread, size_t begin, size_t end) {
                ++ranges[thread];
                for (size_t i = begin; i < end; ++i) {
                    ++visits[i];
                }
            });
            for (const auto& times : visits) {
                EXPECT_EQ(times, 1) << count << " things on " << threads << " threads";
            }
            for (const auto& times : ranges) {
                EXPECT_EQ(times, 1) << count << " things on " << threads << " threads";
            }
        }
    }
}

TEST(Parallel, EachThing_IsTakenOnce) {
    for (const size_t count : {0U, 1U, 7U, 1000U}) {
        for (const size_t threads : {1U, 3U, 16U}) {
            std::vector<std::atomic<int>> visits(count);
            eachOnThreads(count, threads, [&](size_t i) { ++visits[i]; });
            for (const auto& times : visits) {
                EXPECT_EQ(times, 1) << count << " things on " << threads << " threads";
            }
        }
    }
}

TEST(Parallel, FewThings_HaveOneThread) {
    EXPECT_EQ(threadCount(0, 100), 1U);
    EXPECT_EQ(threadCount(199, 100), 1U);
    EXPECT_LE(threadCount(1'000'000'000, 100), 16U);
}

TEST(Parallel, WhatAJobThrows_IsThrownWhenAllAreDone) {
    std::atomic<int> done = 0;
    const auto job = [&](size_t thread, size_t /*begin*/, size_t /*end*/) {
        if (thread == 2) {
            throw std::runtime_error("no");
        }
        ++done;
    };
    EXPECT_THROW(onThreads(100, 4, job), std::runtime_error);
    EXPECT_EQ(done, 3);
}

} // namespace
} // namespace froxel

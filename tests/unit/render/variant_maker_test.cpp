// Variants that are made where nobody waits for them.
#include "render/pipelines/variant_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace froxel::render {
namespace {

struct NoTimeline {
    [[nodiscard]] static uint64_t next() { return 1; }
    [[nodiscard]] static uint64_t completed() { return 0; }
};
using Cache = VariantCache<int, int, NoTimeline>;

// Until the maker is through with what this asker wanted.
void waitFor(const VariantMaker& maker, const void* asker) {
    while (maker.busyFor(asker)) {
        std::this_thread::yield();
    }
}

} // namespace

TEST(VariantMaker, InBackground_IsAskedForOnce_AndThenThere) {
    const NoTimeline timeline;
    VariantMaker maker;
    Cache cache(timeline, maker, 4);
    maker.start(0, 1);
    maker.setAsker(&cache);
    std::atomic<int> made = 0;
    const auto make = [&] { return 10 + made++; };
    EXPECT_THROW((void)cache.findOrMake(1, make), VariantsMissing);
    waitFor(maker, &cache);
    EXPECT_EQ(cache.findOrMake(1, make), 10);
    EXPECT_EQ(made, 1);
}

TEST(VariantMaker, WhatMakingThrew_IsThrownToWhoAsksNext) {
    const NoTimeline timeline;
    VariantMaker maker;
    Cache cache(timeline, maker, 4);
    maker.start(0, 1);
    maker.setAsker(&cache);
    const auto make = []() -> int { throw std::runtime_error("no"); };
    EXPECT_FALSE(cache.prepare(1, make));
    waitFor(maker, &cache);
    EXPECT_THROW((void)cache.prepare(1, make), std::runtime_error);
}

TEST(VariantMaker, SeveralThreads_MakeSeveralAtOnce) {
    VariantMaker maker;
    std::promise<void> begun;
    std::atomic<bool> in_time = false;
    const int asker = 0;
    maker.start(0, 2);
    maker.setAsker(&asker);
    maker.post([&] {
        in_time =
            begun.get_future().wait_for(std::chrono::seconds(10)) == std::future_status::ready;
    });
    maker.post([&] { begun.set_value(); });
    waitFor(maker, &asker);
    EXPECT_TRUE(in_time);
}

TEST(VariantMaker, SeveralThreads_MakeTheSameOnce) {
    const NoTimeline timeline;
    VariantMaker maker;
    Cache cache(timeline, maker, 64);
    const int one = 0;
    const int other = 0;
    maker.start(0, 3);
    std::atomic<int> made = 0;
    const auto make = [&] {
        std::this_thread::yield();
        return ++made;
    };
    for (int key = 0; key < 50; ++key) {
        for (const int* asker : {&one, &other}) {
            maker.setAsker(asker);
            (void)cache.prepare(key, make);
        }
    }
    waitFor(maker, &one);
    waitFor(maker, &other);
    EXPECT_EQ(made, 50);
    for (int key = 0; key < 50; ++key) {
        EXPECT_TRUE(cache.prepare(key, make)) << key;
    }
}

TEST(VariantMaker, WhoNeedsFew_DoesNotWaitForWhoNeedsMany) {
    VariantMaker maker;
    std::mutex mutex;
    std::vector<int> order;
    std::promise<void> open;
    auto opened = open.get_future().share();
    const auto note = [&](int what) {
        return [&, what] {
            opened.wait();
            const std::lock_guard lock(mutex);
            order.push_back(what);
        };
    };
    const int many = 0;
    const int few = 0;
    maker.start(0, 1);
    maker.setAsker(&many);
    for (int i = 0; i < 4; ++i) {
        maker.post(note(1));
    }
    maker.setAsker(&few);
    maker.post(note(2));
    open.set_value();
    waitFor(maker, &many);
    waitFor(maker, &few);
    const auto place = std::find(order.begin(), order.end(), 2) - order.begin();
    EXPECT_LE(place, 2);
    EXPECT_EQ(order.size(), 5U);
}

TEST(VariantMaker, WhatAnAskerThatIsGoneWanted_IsDropped_AndMadeForTheNext) {
    const NoTimeline timeline;
    VariantMaker maker;
    Cache cache(timeline, maker, 4);
    std::promise<void> open;
    auto opened = open.get_future().share();
    const int gone = 0;
    const int next = 0;
    maker.start(0, 1);
    maker.setAsker(&gone);
    maker.post([opened] { opened.wait(); });
    std::atomic<int> made = 0;
    const auto make = [&] { return ++made; };
    EXPECT_FALSE(cache.prepare(1, make));
    maker.forget(&gone);
    maker.setAsker(&next);
    EXPECT_FALSE(cache.prepare(1, make));
    open.set_value();
    waitFor(maker, &gone);
    waitFor(maker, &next);
    EXPECT_TRUE(cache.prepare(1, make));
    EXPECT_EQ(made, 1);
}

TEST(VariantMaker, FirstUses_AreThoseOfAllFrames_UntilOneHasRun) {
    const NoTimeline timeline;
    VariantMaker maker;
    Cache cache(timeline, maker, 4);
    const auto record = [&] {
        maker.setAsker(&cache);
        maker.beginRecording();
        (void)cache.findOrMake(1, [] { return 1; });
        EXPECT_FALSE(cache.isNew(1)) << "one recording counts it once";
        (void)cache.findOrMake(1, [] { return 1; });
        const size_t first_uses = maker.firstUses();
        return std::pair(first_uses, maker.endRecording(1));
    };
    auto [of_given_up, given_up] = record();
    EXPECT_EQ(of_given_up, 1U);
    given_up.giveUp();
    given_up.end();
    maker.setAsker(&cache);
    EXPECT_TRUE(cache.isNew(1));

    auto [of_waiting, waiting] = record();
    auto [of_running, running] = record();
    EXPECT_EQ(of_waiting, 1U);
    EXPECT_EQ(of_running, 1U);
    running.end();
    auto [of_next, next] = record();
    EXPECT_EQ(of_next, 0U);
}

} // namespace froxel::render

#include "load/capacity.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace froxel::load {
namespace {

// Runs the search against a server; how many trials it took.
uint32_t run(CapacitySearch& search, const std::function<bool(uint32_t)>& holds) {
    uint32_t count = 0;
    while (const auto viewers = search.next()) {
        EXPECT_GT(*viewers, 0U);
        search.note(*viewers, holds(*viewers));
        if (++count > 500) {
            ADD_FAILURE() << "it never ends";
            break;
        }
    }
    return count;
}

TEST(Capacity, ServerWithASharpLimit_IsFound) {
    for (uint32_t limit = 1; limit < 200; ++limit) {
        CapacitySearch search(1000, 3);
        const uint32_t count = run(search, [limit](uint32_t viewers) { return viewers <= limit; });
        EXPECT_EQ(search.held(), limit);
        EXPECT_EQ(search.broken(), limit + 1);
        EXPECT_EQ(search.trials().at(limit).held, 3U);
        EXPECT_EQ(search.trials().at(limit + 1).all, 3U);
        EXPECT_LE(count, 24U) << limit;
    }
}

TEST(Capacity, NotEvenOne_IsNone) {
    CapacitySearch search(1000, 3);
    EXPECT_EQ(run(search, [](uint32_t) { return false; }), 3U);
    EXPECT_EQ(search.held(), 0U);
    EXPECT_EQ(search.broken(), 1U);
}

TEST(Capacity, AllThatMayBeTried_Hold_HasNoLimit) {
    CapacitySearch search(20, 2);
    run(search, [](uint32_t) { return true; });
    EXPECT_EQ(search.held(), 20U);
    EXPECT_EQ(search.broken(), std::nullopt);
    EXPECT_EQ(search.trials().at(20).all, 2U);
}

// Between 40 and 50 it is a matter of luck.
TEST(Capacity, ServerThatVaries_IsBracketed) {
    for (uint32_t seed = 0; seed < 200; ++seed) {
        std::mt19937 random(seed);
        CapacitySearch search(1000, 3);
        run(search, [&random](uint32_t viewers) {
            return viewers < 40 || (viewers <= 50 && random() % 2 == 0);
        });
        EXPECT_GE(search.held(), 39U);
        EXPECT_LE(search.held(), 50U);
        ASSERT_TRUE(search.broken());
        EXPECT_GT(*search.broken(), search.held());
        EXPECT_LE(*search.broken(), 51U);
        EXPECT_EQ(search.trials().at(search.held()).held, 3U);
        EXPECT_EQ(search.trials().at(*search.broken()).held, 0U);
        for (uint32_t between = search.held() + 1; between < *search.broken(); ++between) {
            EXPECT_TRUE(search.trials().contains(between)) << "what lies between was tried";
        }
    }
}

} // namespace
} // namespace froxel::load

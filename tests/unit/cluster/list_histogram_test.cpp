#include "cluster/list_histogram.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

namespace froxel::cluster::testing {
namespace {

TEST(Histogram, Buckets_CoverEveryLengthInOrder) {
    EXPECT_EQ(io::histogramBucket(0), 0U);
    EXPECT_EQ(io::histogramBucket(std::numeric_limits<uint32_t>::max()), io::kHistogramBuckets - 1);
    uint32_t next = 0; // the smallest length not yet covered
    for (uint32_t bucket = 0; bucket < io::kHistogramBuckets; ++bucket) {
        const uint32_t upper = io::histogramUpper(bucket);
        ASSERT_EQ(io::histogramBucket(next), bucket);
        ASSERT_EQ(io::histogramBucket(upper), bucket);
        ASSERT_GE(upper, next);
        ASSERT_LE(upper - next, next / io::kHistogramSteps);
        next = upper + 1;
    }
    EXPECT_EQ(next, 0U); // wrapped: nothing is left
}

TEST(ListHistogram, P95_IsThatOfTheSortedLengthsToASixteenth) {
    std::mt19937 random(1);
    for (const uint32_t longest : {0U, 1U, 15U, 16U, 17U, 300U, 1'000'000U}) {
        for (const size_t count : {1U, 19U, 20U, 21U, 3456U}) {
            std::vector<uint32_t> lengths;
            ListHistogram histogram;
            for (size_t i = 0; i < count; ++i) {
                const auto length = static_cast<uint32_t>(random() % (longest + 1U));
                histogram.add(length);
                if (length > 0) {
                    lengths.push_back(length);
                }
            }
            std::sort(lengths.begin(), lengths.end());
            const uint32_t largest = lengths.empty() ? 0U : lengths.back();
            const uint32_t p95 = histogram.p95(largest);
            if (lengths.empty()) {
                EXPECT_EQ(p95, 0U);
                continue;
            }
            const uint32_t exact = lengths[(lengths.size() * 95 + 99) / 100 - 1];
            EXPECT_GE(p95, exact);
            EXPECT_LE(p95, std::min(exact + exact / 16, largest));
        }
    }
}

} // namespace
} // namespace froxel::cluster::testing

#include "report/statistics.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <random>

namespace froxel::report {
namespace {

std::vector<double> logNormal(uint32_t seed, size_t count, double median) {
    std::mt19937 random(seed);
    std::lognormal_distribution<double> spread(0, 0.05);
    std::vector<double> samples(count);
    for (auto& sample : samples) {
        sample = median * spread(random);
    }
    return samples;
}

TEST(Summarize, OneSample_IsEveryNumber) {
    const auto summary = summarize({7});
    EXPECT_EQ(summary.count, 1u);
    for (const double number : {summary.min, summary.p5, summary.median, summary.p95, summary.p99,
                                summary.max, summary.mean}) {
        EXPECT_EQ(number, 7);
    }
}

TEST(Summarize, EvenCount_MedianIsMeanOfMiddleTwo) {
    EXPECT_EQ(summarize({4, 1, 3, 2}).median, 2.5);
    EXPECT_EQ(summarize({4, 1, 3, 2}).mean, 2.5);
}

TEST(Summarize, HundredSamples_PercentilesAreTheirRanks) {
    std::vector<double> samples(100);
    std::iota(samples.rbegin(), samples.rend(), 1); // 100 .. 1
    const auto summary = summarize(samples);
    EXPECT_EQ(summary.p5, 5);
    EXPECT_EQ(summary.median, 50.5);
    EXPECT_EQ(summary.p95, 95);
    EXPECT_EQ(summary.p99, 99);
}

TEST(Summarize, FewSamples_PercentilesAreMeasuredSamples) {
    const auto summary = summarize({10, 20, 30});
    EXPECT_EQ(summary.p5, 10);
    EXPECT_EQ(summary.p95, 30);
    EXPECT_EQ(summary.p99, 30);
}

TEST(StatisticsDeathTest, NoOrNonFiniteSamples_AreABug) {
    EXPECT_DEATH((void)summarize({}), "need a sample");
    EXPECT_DEATH((void)summarize({1, std::numeric_limits<double>::quiet_NaN()}), "finite");
}

// By hand: ranks of a are 1..4 of 8, so U = 0, mean 8, variance 16 / 12 * 9 = 12, and with the
// continuity correction z = 7.5 / sqrt(12) = 2.16506; 2 * (1 - Phi(z)) = 0.030383 (tables of the
// normal).
TEST(CompareSamples, SeparateSamples_PValueIsThatOfTheNormal) {
    EXPECT_NEAR(compareSamples({1, 2, 3, 4}, {5, 6, 7, 8}).p_value, 0.030383, 2e-6);
}

// By hand: pooled 1 | 2 2 2 | 3 3, mean ranks 1, 3, 5.5. a = {1, 2, 2}: 7, so U = 1, mean 4.5. Ties
// 24 + 6 = 30: variance 9 / 12 * (7 - 30 / 30) = 4.5, z = 3 / sqrt(4.5) = sqrt(2): 0.157299 =
// erfc(1).
TEST(CompareSamples, Ties_NarrowTheVariance) {
    EXPECT_NEAR(compareSamples({1, 2, 2}, {2, 3, 3}).p_value, 0.157299, 1e-6);
}

TEST(CompareSamples, EqualSamples_DoNotDiffer) {
    const std::vector<double> constant(50, 3.0);
    const auto comparison = compareSamples(constant, constant);
    EXPECT_EQ(comparison.ratio, 1);
    EXPECT_EQ(comparison.p_value, 1);
    EXPECT_FALSE(comparison.differs);
}

TEST(CompareSamples, TenPercentSlower_Differs) {
    const auto comparison = compareSamples(logNormal(1, 100, 10), logNormal(2, 100, 11));
    EXPECT_TRUE(comparison.differs);
    EXPECT_NEAR(comparison.ratio, 1.1, 0.02);
    EXPECT_NE(comparison.words.find(" times as long as a (p < 1e-6)"), std::string::npos)
        << comparison.words;
}

TEST(CompareSamples, OnePercentSlower_IsBelowTheLeastEffect) {
    const auto comparison = compareSamples(logNormal(1, 20000, 10), logNormal(2, 20000, 10.1));
    EXPECT_LT(comparison.p_value, kSignificance);
    EXPECT_FALSE(comparison.differs);
}

// 2,000 pairs from one distribution: about 2 (0.1 %) should reach the significance by chance, more
// than 10 would by less than 1 in 10,000.
TEST(CompareSamples, SameDistribution_SeldomReachesSignificance) {
    int significant = 0;
    for (uint32_t seed = 0; seed < 2000; ++seed) {
        const auto comparison =
            compareSamples(logNormal(2 * seed, 30, 10), logNormal(2 * seed + 1, 30, 10));
        significant += comparison.p_value < kSignificance ? 1 : 0;
    }
    EXPECT_LE(significant, 10);
}

TEST(CompareSamples, FewSamples_NeverDiffer) {
    const std::vector<double> long_run(1000, 1.0);
    const auto comparison = compareSamples(long_run, std::vector<double>(kLeastSamples - 1, 9.0));
    EXPECT_FALSE(comparison.differs);
    EXPECT_NE(comparison.words.find("too few"), std::string::npos);
    EXPECT_TRUE(compareSamples(long_run, std::vector<double>(kLeastSamples, 9.0)).differs);
}

TEST(CompareSamples, ZeroMedian_HasAnInfiniteOrUnitRatio) {
    const std::vector<double> zeros(20, 0.0);
    EXPECT_EQ(compareSamples(zeros, std::vector<double>(20, 2.0)).ratio,
              std::numeric_limits<double>::infinity());
    EXPECT_EQ(compareSamples(zeros, zeros).ratio, 1);
}

TEST(CompareSamples, OrderOfArguments_InvertsRatioAndKeepsPValue) {
    const auto a = logNormal(1, 100, 10);
    const auto b = logNormal(2, 80, 11);
    const auto forward = compareSamples(a, b);
    const auto backward = compareSamples(b, a);
    EXPECT_DOUBLE_EQ(forward.p_value, backward.p_value);
    EXPECT_DOUBLE_EQ(forward.ratio, 1 / backward.ratio);
}

} // namespace
} // namespace froxel::report

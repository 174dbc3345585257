#include "report/statistics.h"

#include "core/assert.h"

#include <boost/math/distributions/normal.hpp>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace froxel::report {

namespace {

void expectFinite(const std::vector<double>& samples) {
    FROXEL_ASSERT(!samples.empty(), "statistics need a sample");
    FROXEL_ASSERT(std::all_of(samples.begin(), samples.end(),
                              [](double sample) { return std::isfinite(sample); }),
                  "statistics need finite samples");
}

double nearestRank(const std::vector<double>& sorted, size_t percent) {
    const size_t rank = (sorted.size() * percent + 99) / 100; // 1-based, rounded up
    return sorted[rank - 1];
}

struct RankSums {
    double of_a = 0; // sum of a's ranks among all, equal samples sharing their mean rank
    double ties = 0; // sum of t^3 - t over groups of t equal samples
};

RankSums rankSums(const std::vector<double>& a, const std::vector<double>& b) {
    struct Ranked {
        double value;
        bool is_a;
    };
    std::vector<Ranked> all;
    all.reserve(a.size() + b.size());
    for (const double value : a) {
        all.push_back({value, true});
    }
    for (const double value : b) {
        all.push_back({value, false});
    }
    std::sort(all.begin(), all.end(),
              [](const Ranked& left, const Ranked& right) { return left.value < right.value; });
    RankSums sums;
    for (auto first = all.begin(); first != all.end();) {
        const auto last = std::find_if(
            first, all.end(), [&](const Ranked& ranked) { return ranked.value != first->value; });
        const auto tied = static_cast<double>(last - first);
        const double mean_rank = static_cast<double>(first - all.begin()) + 0.5 * (tied + 1);
        sums.of_a +=
            mean_rank *
            static_cast<double>(std::count_if(first, last, [](const Ranked& r) { return r.is_a; }));
        sums.ties += tied * tied * tied - tied;
        first = last;
    }
    return sums;
}

double mannWhitney(const std::vector<double>& a, const std::vector<double>& b) {
    const auto m = static_cast<double>(a.size());
    const auto n = static_cast<double>(b.size());
    const auto sums = rankSums(a, b);
    const double u = sums.of_a - 0.5 * m * (m + 1);
    const double variance = m * n / 12 * (m + n + 1 - sums.ties / ((m + n) * (m + n - 1)));
    if (variance <= 0) { // every sample equal
        return 1;
    }
    const double distance = std::max(0.0, std::abs(u - 0.5 * m * n) - 0.5);
    const boost::math::normal standard;
    return 2 * boost::math::cdf(boost::math::complement(standard, distance / std::sqrt(variance)));
}

double ratioOf(double before, double after) {
    if (before == after) {
        return 1;
    }
    return before == 0 ? std::numeric_limits<double>::infinity() : after / before;
}

std::string wordsOf(const Comparison& comparison, size_t least_count) {
    if (least_count < kLeastSamples) {
        return fmt::format("too few samples to tell ({}, {} needed)", least_count, kLeastSamples);
    }
    const auto chance = comparison.p_value < 1e-6 ? std::string("p < 1e-6")
                                                  : fmt::format("p = {:.2g}", comparison.p_value);
    if (!comparison.differs) {
        return fmt::format("no difference beyond the noise (ratio {:.3f}, {})", comparison.ratio,
                           chance);
    }
    return fmt::format("b takes {:.3g} times as long as a ({})", comparison.ratio, chance);
}

} // namespace

double percentileOf(std::vector<double> samples, double percent) {
    expectFinite(samples);
    FROXEL_ASSERT(percent > 0 && percent <= 100, "no such percentile");
    // Of 1000 samples 99.9 % are 999, which the product exceeds by its rounding.
    constexpr double kRounding = 1e-9;
    const double rank = std::ceil(static_cast<double>(samples.size()) * percent / 100 - kRounding);
    const auto at = samples.begin() + static_cast<ptrdiff_t>(std::max(rank, 1.0)) - 1;
    std::nth_element(samples.begin(), at, samples.end());
    return *at;
}

Summary summarize(std::vector<double> samples) {
    expectFinite(samples);
    std::sort(samples.begin(), samples.end());
    const size_t count = samples.size();
    return {.count = count,
            .min = samples.front(),
            .p5 = nearestRank(samples, 5),
            .median = 0.5 * (samples[(count - 1) / 2] + samples[count / 2]),
            .p95 = nearestRank(samples, 95),
            .p99 = nearestRank(samples, 99),
            .max = samples.back(),
            .mean =
                std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(count)};
}

Comparison compareSamples(const std::vector<double>& a, const std::vector<double>& b) {
    expectFinite(a);
    expectFinite(b);
    Comparison comparison;
    comparison.ratio = ratioOf(summarize(a).median, summarize(b).median);
    comparison.p_value = mannWhitney(a, b);
    const size_t least_count = std::min(a.size(), b.size());
    comparison.differs = least_count >= kLeastSamples && comparison.p_value < kSignificance &&
                         std::abs(comparison.ratio - 1) > kLeastEffect;
    comparison.words = wordsOf(comparison, least_count);
    return comparison;
}

} // namespace froxel::report

// Timings to the few numbers that a report gives, and whether two sets of them differ. Pure
// functions, any thread; samples in any unit and order.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace froxel::report {

// Percentiles are nearest ranks, without interpolation: the least sample that at least p % of all
// do not exceed, so each was measured. The median is the mean of the middle two for an even count.
struct Summary {
    size_t count = 0;
    double min = 0;
    double p5 = 0;
    double median = 0;
    double p95 = 0;
    double p99 = 0;
    double max = 0;
    double mean = 0;
};

// The nearest rank of a percentile above 0 and up to 100. At least one sample, all finite.
[[nodiscard]] double percentileOf(std::vector<double> samples, double percent);

// At least one sample, all finite.
[[nodiscard]] Summary summarize(std::vector<double> samples);

struct Comparison {
    double ratio = 1;   // median of b / median of a; infinity where only a's is 0
    double p_value = 1; // two-sided: chance of ranks as uneven as these were both alike
    bool differs = false;
    std::string words; // "b takes 1.24 times as long as a (p < 1e-6)"
};

// What counts as a difference: a p value below kSignificance and medians kLeastEffect apart. The
// first is strict because a report compares hundreds of rows; the second because frames of one run
// are not independent, so that drift of a few percent gets small p values too.
inline constexpr double kSignificance = 0.001;
inline constexpr double kLeastEffect = 0.03;
// Below this many samples on either side the normal approximation is poor: they never count as
// different.
inline constexpr size_t kLeastSamples = 8;

// Mann and Whitney's U test (Ann. Math. Statist. 18(1), 1947) by the normal approximation with
// corrections for ties and continuity (Lehmann, Nonparametrics, 1975, sections 1.2 to 1.4): no
// assumption on the distribution, which has a long tail for timings. Each at least one sample,
// finite, not negative.
[[nodiscard]] Comparison compareSamples(const std::vector<double>& a, const std::vector<double>& b);

} // namespace froxel::report

// Samples of one quantity to the four numbers that a report gives.
#pragma once

#include <vector>

namespace froxel::app {

struct SampleSummary {
    double min = 0;
    double median = 0; // mean of the middle two for an even count
    double p95 = 0;    // nearest rank: the least sample that 95 % of all do not exceed
    double max = 0;
};

// At least one sample; any order.
[[nodiscard]] SampleSummary summarize(std::vector<double> samples);

} // namespace froxel::app

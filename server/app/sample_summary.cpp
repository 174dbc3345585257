#include "app/sample_summary.h"

#include "core/assert.h"

#include <algorithm>
#include <cstddef>

namespace froxel::app {

SampleSummary summarize(std::vector<double> samples) {
    FROXEL_ASSERT(!samples.empty(), "a summary needs a sample");
    std::sort(samples.begin(), samples.end());
    const size_t count = samples.size();
    const size_t rank = (count * 95 + 99) / 100; // 1-based, rounded up
    return {.min = samples.front(),
            .median = 0.5 * (samples[(count - 1) / 2] + samples[count / 2]),
            .p95 = samples[rank - 1],
            .max = samples.back()};
}

} // namespace froxel::app

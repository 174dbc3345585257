// What a load test requires of what its viewers measured, as text: "latency.p99<80, fps>=30". Pure.
//
//   FIGURE[.STATISTIC[.STATISTIC]] (< | <= | > | >=) NUMBER[%]
//
// A statistic is min, mean, median, max or pN, such as p95 or p99.9: a nearest rank
// (report/statistics.h).
//
//   sample figures, in ms: latency, reaction, age and the others of kSampleSeries. The first
//       statistic is of all viewers' samples together. With a second one, the first is of each
//       viewer's samples, and the second of these values: latency.p95.max is the worst viewer's.
//   viewer figures, one value for each: fps, mbps, stall, first_frame, jitter, dropped. The
//       statistic is over the viewers; without one it is the worst viewer's, which the comparison
//       tells.
//   run figures: refused and failed, as shares of all viewers that tried to connect; errors and
//   unshown, as numbers.
//       They have no statistic.
#pragma once

#include "core/error.h"
#include "load/load_run.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace froxel::load {

enum class Comparison : uint8_t { kLess, kAtMost, kGreater, kAtLeast };

struct Statistic {
    enum class Kind : uint8_t { kMin, kMean, kMedian, kMax, kPercentile };
    Kind kind = Kind::kMean;
    double percent = 0; // of kPercentile: above 0 and up to 100
    bool operator==(const Statistic&) const = default;
};

struct Requirement {
    std::string text;  // as given, without spaces
    size_t figure = 0; // of an order of requirement.cpp's own
    std::vector<Statistic> statistics;
    Comparison comparison = Comparison::kLess;
    double limit = 0;
};

// Separated by commas. Errors: kInvalidArgument, naming the requirement.
[[nodiscard]] Result<std::vector<Requirement>> parseRequirements(std::string_view text);

// "latency", of "latency.p99<80".
[[nodiscard]] std::string_view figureOf(const Requirement& requirement);
[[nodiscard]] bool namesFigure(const std::vector<Requirement>& requirements,
                               std::string_view figure);

struct Outcome {
    std::string requirement;        // its text
    std::optional<double> measured; // none: nobody measured it
    bool held = false;              // false where nothing was measured
};

[[nodiscard]] std::vector<Outcome> check(const std::vector<Requirement>& requirements,
                                         const RunResult& result);

// "latency.p99<80: 93.2", or "latency.p99<80: no sample".
[[nodiscard]] std::string wordsOf(const Outcome& outcome);

// The least time such that for 95 % of the measured time no frame had been due for longer: the
// percentile that a stall raises by its length, however few frames and commands are in it. 0: no
// frame was due, or nothing was measured.
[[nodiscard]] double stallMs(const Measured& measured);

} // namespace froxel::load

// What a run of `froxel bench` found.
#pragma once

#include "bench/budget.h"
#include "bench/errors.h"
#include "bench/runner.h"
#include "bench/stream.h"
#include "bench/sweep.h"
#include "report/device_summary.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace froxel::bench {

struct RowResult {
    RowTimes times;
    RowErrors errors;
    std::optional<uint32_t> gbuffer_bytes_per_pixel;
    std::optional<StreamError> stream; // of rows that ask for it
};

struct SweepResult {
    Sweep sweep;
    std::vector<RowResult> rows; // in the sweep's order
};

struct RunResult {
    std::string date; // UTC, ISO 8601
    bool complete = false;
    double elapsed_s = 0;
    report::DeviceSummary device;
    std::string scene_source; // as given
    std::string scene_name;
    size_t triangle_count = 0;
    Budget budget;
    ErrorOptions error_options;
    Base base;
    std::vector<SweepResult> sweeps;
};

// A line for each row whose R1 error is not 0: "light_count: naive, 100 lights: ...".
[[nodiscard]] std::vector<std::string> inexactRows(const RunResult& result);

} // namespace froxel::bench

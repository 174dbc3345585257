// What a run of `froxel bench` found.
#pragma once

#include "app/bench_budget.h"
#include "app/bench_errors.h"
#include "app/bench_runner.h"
#include "app/bench_stream.h"
#include "app/bench_sweep.h"
#include "app/device_summary.h"
#include "gpu/device_options.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace froxel::app {

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

struct BenchResult {
    std::string date; // UTC, ISO 8601
    bool complete = false;
    double elapsed_s = 0;
    DeviceSummary device;
    gpu::DeviceChoice device_choice = gpu::DeviceChoice::kAuto;
    std::string scene_source;        // as given
    std::filesystem::path light_set; // as given; empty: none
    std::string scene_name;
    size_t triangle_count = 0;
    BenchBudget budget;
    ErrorOptions error_options;
    BenchBase base;
    std::vector<SweepResult> sweeps;
};

// A line for each row whose R1 error is not 0: "light_count: naive, 100 lights: ...".
[[nodiscard]] std::vector<std::string> inexactRows(const BenchResult& result);

} // namespace froxel::app

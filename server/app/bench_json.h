// A result as JSON, whose schema is in tests/bench/results/README.md.
#pragma once

#include "app/bench_result.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace froxel::app {

inline constexpr const char* kBenchSchema = "froxel.bench.v1";

[[nodiscard]] nlohmann::ordered_json benchReport(const BenchResult& result);

// The `froxel render` command line that draws a row's frames.
[[nodiscard]] std::string
commandOf(const BenchResult& result, const BenchRow& row, size_t frame_count);

} // namespace froxel::app

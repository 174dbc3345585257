// A result as JSON, whose schema is in tests/bench/results/README.md.
#pragma once

#include "bench/result.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <functional>
#include <string>

namespace froxel::bench {

inline constexpr const char* kSchema = "froxel.bench.v1";

// The command line that draws so many frames of a row.
using CommandOf = std::function<std::string(const Row& row, size_t frame_count)>;

[[nodiscard]] nlohmann::ordered_json runReport(const RunResult& result,
                                               const CommandOf& command_of);

} // namespace froxel::bench

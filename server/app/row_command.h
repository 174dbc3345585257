// A row of `froxel bench` as the `froxel render` command line that draws its frames.
#pragma once

#include "app/bench_command.h"
#include "bench/result.h"

#include <cstddef>
#include <string>

namespace froxel::app {

// For a POSIX shell, with --timings timings.json. Pure.
[[nodiscard]] std::string rowCommand(const BenchOptions& options,
                                     const bench::RunResult& result,
                                     const bench::Row& row,
                                     size_t frame_count);

} // namespace froxel::app

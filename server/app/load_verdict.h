// Whether what the viewers of `froxel load` measured is within its bounds. Pure functions.
#pragma once

#include "app/load_command.h"
#include "load/load_run.h"

#include <optional>
#include <string>

namespace froxel::app {

// The least time such that for 95 % of the measured time no frame had been due for longer: the
// percentile that a stall raises by its length, however few frames and commands are in it. 0: no
// frame was due, or nothing was measured.
[[nodiscard]] double stallMs(const load::Measured& measured);

// One line where a viewer failed or a bound is broken. --max-latency-ms is of the worst of a
// viewer's 95th percentiles of latency and reaction and its stallMs(); of a watcher's the last
// alone, and who controls and measured no latency breaks any.
[[nodiscard]] std::optional<std::string> loadVerdict(const LoadOptions& options,
                                                     const load::RunResult& result);

} // namespace froxel::app

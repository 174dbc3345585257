// The named sweeps of `froxel bench`. Pure.
#pragma once

#include "app/bench_sweep.h"

#include <span>
#include <string_view>

namespace froxel::app {

// All names, and those of a run without --preset: all but `smoke`.
[[nodiscard]] std::span<const std::string_view> benchPresetNames();
[[nodiscard]] std::span<const std::string_view> fullBenchPresetNames();

// `name` is one of benchPresetNames(). What a sweep does not vary is as in `base`.
[[nodiscard]] Sweep makeSweep(std::string_view name, const BenchBase& base);

} // namespace froxel::app

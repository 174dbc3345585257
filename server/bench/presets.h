// The named sweeps of `froxel bench`. Pure.
#pragma once

#include "bench/sweep.h"

#include <span>
#include <string_view>

namespace froxel::bench {

// All names, and those of a run without --preset: all but
// `material_variants` and `smoke`.
[[nodiscard]] std::span<const std::string_view> presetNames();
[[nodiscard]] std::span<const std::string_view> fullPresetNames();

// `name` is one of presetNames(). What a sweep does not vary is as in `base`.
[[nodiscard]] Sweep makeSweep(std::string_view name, const Base& base);

} // namespace froxel::bench

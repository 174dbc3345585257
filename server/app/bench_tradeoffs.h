// Sweeps of what trades error for speed or bytes, off by default, and a try of everything. Pure.
#pragma once

#include "app/bench_sweep.h"

namespace froxel::app {

[[nodiscard]] Sweep gbufferSweep(const BenchBase& base);
[[nodiscard]] Sweep resolutionScaleSweep(const BenchBase& base);
[[nodiscard]] Sweep cutoffSweep(const BenchBase& base);
[[nodiscard]] Sweep compensationSweep(const BenchBase& base);
[[nodiscard]] Sweep listCapSweep(const BenchBase& base);
[[nodiscard]] Sweep bloomSweep(const BenchBase& base);
[[nodiscard]] Sweep shadowSweep(const BenchBase& base);
[[nodiscard]] Sweep areaSweep(const BenchBase& base);
[[nodiscard]] Sweep antialiasingSweep(const BenchBase& base);
[[nodiscard]] Sweep transparencySweep(const BenchBase& base);
[[nodiscard]] Sweep fogSweep(const BenchBase& base);
[[nodiscard]] Sweep streamSweep(const BenchBase& base);
// One row of every kind, small.
[[nodiscard]] Sweep smokeSweep(const BenchBase& base);

} // namespace froxel::app

// Sweeps of what trades error for speed or bytes, off by default, and a try of everything. Pure.
#pragma once

#include "bench/sweep.h"

namespace froxel::bench {

[[nodiscard]] Sweep gbufferSweep(const Base& base);
[[nodiscard]] Sweep geometryErrorSweep(const Base& base);
[[nodiscard]] Sweep resolutionScaleSweep(const Base& base);
[[nodiscard]] Sweep cutoffSweep(const Base& base);
[[nodiscard]] Sweep compensationSweep(const Base& base);
[[nodiscard]] Sweep listCapSweep(const Base& base);
[[nodiscard]] Sweep bloomSweep(const Base& base);
[[nodiscard]] Sweep shadowSweep(const Base& base);
[[nodiscard]] Sweep areaSweep(const Base& base);
[[nodiscard]] Sweep antialiasingSweep(const Base& base);
[[nodiscard]] Sweep transparencySweep(const Base& base);
[[nodiscard]] Sweep fogSweep(const Base& base);
[[nodiscard]] Sweep environmentSweep(const Base& base);
[[nodiscard]] Sweep streamSweep(const Base& base);
// One row of every kind, small.
[[nodiscard]] Sweep smokeSweep(const Base& base);

} // namespace froxel::bench

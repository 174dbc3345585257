// The one clock of everything that waits or measures: monotonic. Pure code takes the time as an
// argument and never reads it.
#pragma once

#include <chrono>

namespace froxel {

using Clock = std::chrono::steady_clock;
using TimePoint = Clock::time_point;
using Seconds = std::chrono::duration<double>;
using Microseconds = std::chrono::duration<double, std::micro>;

} // namespace froxel

// The lights' clock of frames that are timed.
#pragma once

#include "settings/settings.h"

namespace froxel::report {

// Timed frames are this far apart, by a clock that `speed` makes the lights'.
inline constexpr double kFrameStepS = 1.0 / 30.0;
[[nodiscard]] inline double lightStepS(const settings::Lights& lights) {
    return lights.animate ? kFrameStepS * static_cast<double>(lights.speed) : 0.0;
}

} // namespace froxel::report

// Where a clip stands, as a closed form of a clock: pausing, another speed and seeking only move
// the anchor, and reading changes nothing.
#pragma once

#include "settings/settings.h"

namespace froxel::motion {

using settings::Repeat;

// seconds of the clip before it repeats = phase_s + speed * (now - anchor_s).
struct ClipClock {
    double anchor_s = 0; // of the clock that `now_s` is read from
    double phase_s = 0;  // at the anchor
    double speed = 1;    // 0: paused; below 0: backwards
    Repeat repeat = Repeat::kLoop;

    [[nodiscard]] double phaseAt(double now_s) const {
        return phase_s + speed * (now_s - anchor_s);
    }
    // The same place at `now_s`, another speed after it.
    [[nodiscard]] ClipClock withSpeed(double now_s, double other) const {
        return {now_s, phaseAt(now_s), other, repeat};
    }
    // Another place at `now_s`, the same speed.
    [[nodiscard]] ClipClock withPhase(double now_s, double phase) const {
        return {now_s, phase, speed, repeat};
    }
    // The same from `now_s` on, by the phase nearest 0 of those that are the same.
    [[nodiscard]] ClipClock anchoredAt(double now_s, double duration_s) const;
    // Whether the clip's time never changes from `now_s` on.
    [[nodiscard]] bool restsAt(double now_s, double duration_s) const;
    // The clip's own time, 0 to duration_s. A phase that is not finite is 0.
    [[nodiscard]] double timeAt(double now_s, double duration_s) const;

    bool operator==(const ClipClock&) const = default;
};

// How much a clip counts: all of it, or more and more from a time on.
struct Fade {
    double start_s = 0;
    double duration_s = 0; // 0: none

    // 0 to 1, by smoothstep.
    [[nodiscard]] double weightAt(double now_s) const;
    [[nodiscard]] bool isOverAt(double now_s) const {
        return !(duration_s > 0) || now_s - start_s >= duration_s;
    }

    bool operator==(const Fade&) const = default;
};

} // namespace froxel::motion

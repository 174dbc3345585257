// Where a clip stands, as a closed form of a clock: pausing, another speed and seeking only move
// the anchor, and reading changes nothing.
#pragma once

#include <cstdint>

namespace froxel::motion {

enum class Repeat : uint8_t { kLoop, kPingPong, kOnce };

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
    // The clip's own time, 0 to duration_s. A phase that is not finite is 0.
    [[nodiscard]] double timeAt(double now_s, double duration_s) const;

    bool operator==(const ClipClock&) const = default;
};

// How much a clip counts: all of it, or more and more from a time on, or less and less.
struct Fade {
    double start_s = 0;
    double duration_s = 0; // 0: none
    bool out = false;

    // 0 to 1, by smoothstep. The two of a cross-fade sum to 1 but for rounding.
    [[nodiscard]] double weightAt(double now_s) const;

    bool operator==(const Fade&) const = default;
};

} // namespace froxel::motion

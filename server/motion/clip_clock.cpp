#include "motion/clip_clock.h"

#include <algorithm>
#include <cmath>

namespace froxel::motion {

namespace {

// The remainder in [0, period); fmod is exact.
double wrapped(double value, double period) {
    const double rest = std::fmod(value, period);
    const double positive = rest < 0 ? rest + period : rest;
    return positive < period ? positive : 0; // a tiny rest below 0 rounds up to the period
}

} // namespace

ClipClock ClipClock::anchoredAt(double now_s, double duration_s) const {
    const double phase = phaseAt(now_s);
    if (!(duration_s > 0) || !std::isfinite(phase)) {
        return withPhase(now_s, 0);
    }
    switch (repeat) {
    case Repeat::kLoop:
        return withPhase(now_s, wrapped(phase, duration_s));
    case Repeat::kPingPong:
        return withPhase(now_s, wrapped(phase, 2 * duration_s));
    case Repeat::kOnce:
        break;
    }
    return withPhase(now_s, std::clamp(phase, 0.0, duration_s));
}

bool ClipClock::restsAt(double now_s, double duration_s) const {
    const double phase = phaseAt(now_s);
    if (speed == 0 || !(duration_s > 0) || !std::isfinite(phase)) {
        return true;
    }
    return repeat == Repeat::kOnce && (speed > 0 ? phase >= duration_s : phase <= 0);
}

double ClipClock::timeAt(double now_s, double duration_s) const {
    const double phase = phaseAt(now_s);
    if (!(duration_s > 0) || !std::isfinite(phase)) {
        return 0;
    }
    switch (repeat) {
    case Repeat::kLoop:
        return wrapped(phase, duration_s);
    case Repeat::kPingPong: {
        const double there_and_back = wrapped(phase, 2 * duration_s);
        return std::min(there_and_back, 2 * duration_s - there_and_back);
    }
    case Repeat::kOnce:
        return std::clamp(phase, 0.0, duration_s);
    }
    return 0;
}

double Fade::weightAt(double now_s) const {
    if (!(duration_s > 0)) {
        return 1;
    }
    const double t = std::clamp((now_s - start_s) / duration_s, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

} // namespace froxel::motion

#include "gltf/load_progress.h"

namespace froxel::gltf {
namespace {

// What people see as no delay.
constexpr Seconds kPause{0.05};

// Images take most of the time: of Sponza, on two cores, 0.7 of 0.8 s.
constexpr double kReadPart = 0.2;

} // namespace

void LoadProgress::reading(double part) {
    tell("reading the scene", kReadPart * part);
}

void LoadProgress::decoding(double part) {
    tell("decoding its images", kReadPart + (1 - kReadPart) * part);
}

void LoadProgress::ask() {
    const TimePoint now = Clock::now();
    if (now - told_at_ < kPause) {
        return;
    }
    told_at_ = now;
    if (!report_(now_)) {
        throw CalledOff();
    }
}

void LoadProgress::tell(const char* stage, double fraction) {
    if (now_.stage != stage) {
        now_.stage = stage;
        told_at_ = {};
    }
    now_.fraction = fraction;
    ask();
}

} // namespace froxel::gltf

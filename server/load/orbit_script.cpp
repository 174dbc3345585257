#include "load/orbit_script.h"

#include <cmath>
#include <numbers>

namespace froxel::load {
namespace {

// Viewers start this much apart, so that they never look the same way: the golden angle.
constexpr double kApartRad = 2.399963229728653;

} // namespace

v1::SetCamera orbitPose(const v1::ViewState& state, double angle_rad) {
    v1::SetCamera camera;
    *camera.mutable_target() = state.target();
    *camera.mutable_up() = state.up();
    const double x = state.eye().x() - state.target().x();
    const double z = state.eye().z() - state.target().z();
    const double sine = std::sin(angle_rad);
    const double cosine = std::cos(angle_rad);
    camera.mutable_eye()->set_x(state.target().x() + x * cosine + z * sine);
    camera.mutable_eye()->set_y(state.eye().y());
    camera.mutable_eye()->set_z(state.target().z() - x * sine + z * cosine);
    return camera;
}

std::optional<Step> OrbitScript::next() {
    const Seconds at = Seconds(static_cast<double>(count_) / kOrbitRate);
    ++count_;
    Step step;
    step.at = std::chrono::duration_cast<Clock::duration>(at);
    const double turns = at / kOrbitPeriod;
    const double angle_rad = 2 * std::numbers::pi * (turns - std::floor(turns));
    *step.message.mutable_set_camera() = orbitPose(start_, angle_rad + kApartRad * (viewer_ - 1));
    return step;
}

} // namespace froxel::load

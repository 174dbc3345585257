#include "load/path_script.h"

#include "session/proto_vec.h"

#include <cmath>
#include <utility>

namespace froxel::load {
namespace {

// Viewers start this share of a path apart, so that they never look the same way: the golden ratio.
constexpr double kApart = 0.6180339887498949;

v1::SetCamera cameraOf(const settings::Camera& camera) {
    v1::SetCamera command;
    session::fillVec(*command.mutable_eye(), camera.eye_world);
    session::fillVec(*command.mutable_target(), camera.target_world());
    session::fillVec(*command.mutable_up(), camera.world_from_view[1]);
    command.set_fov_deg(glm::degrees(camera.yfov_rad));
    return command;
}

} // namespace

PathScript::PathScript(Path path, uint32_t viewer)
    : path_(std::move(path)), begin_s_(std::fmod(kApart * (viewer - 1), 1.0) * path_->seconds()) {}

std::optional<Step> PathScript::next() {
    const double seconds = path_->seconds();
    if (seconds == 0 && count_ > 0) {
        return std::nullopt;
    }
    const Seconds at = Seconds(static_cast<double>(count_) / kPathRate);
    ++count_;
    Step step;
    step.at = std::chrono::duration_cast<Clock::duration>(at);
    const double on_path_s = seconds > 0 ? std::fmod(begin_s_ + at.count(), seconds) : 0;
    *step.message.mutable_set_camera() = cameraOf(path_->at(on_path_s));
    return step;
}

} // namespace froxel::load

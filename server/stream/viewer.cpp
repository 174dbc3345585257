#include "stream/viewer.h"

#include <algorithm>
#include <utility>

namespace froxel::stream {

Viewer::Viewer(const ViewerNews& first, std::shared_ptr<FramePipeline> its_pipeline)
    : sink(first.sink), pipeline(std::move(its_pipeline)), state(*first.state) {}

std::optional<TimePoint> Viewer::wantsFrameAt() const {
    if (leaving || blocked) {
        return {};
    }
    if (moves()) {
        return std::max(paced_until, ask_again);
    }
    const auto due = refineNext();
    return due ? std::optional(std::max(due->at, ask_again)) : std::nullopt;
}

std::optional<session::RefinementSchedule::Due> Viewer::refineNext() const {
    return refinement.next(state.delivery.refine, delivery, state.settings.size);
}

session::Delivered Viewer::nextDelivered() const {
    const auto due = moves() ? std::nullopt : refineNext();
    session::Delivery limits = delivery;
    limits.scale = std::min(limits.scale, render_scale.scale());
    return session::delivered(state.encoding, limits,
                              due ? due->stage : session::Refinement::kInteractive);
}

void Viewer::noteBegun(const session::Delivered& with, TimePoint now) {
    const bool limited = with.scale < 1 || with.encoding != state.encoding;
    refinement.onBegun(with.refinement, limited);
    if (moves()) {
        paced_until = now + std::chrono::duration_cast<Clock::duration>(delivery.min_interval);
    }
    changed = false;
    submitted = state;
    ++under_way;
    ++started;
}

bool Viewer::hasRoom() const {
    return started < granted && under_way + pipeline->size() < FramePipeline::kCapacity &&
           (source == nullptr || source->canBegin());
}

bool Viewer::waitsInVain() const {
    if (leaving || blocked) {
        return true;
    }
    const bool taken_back = granted < started; // it paused
    return (taken_back || waiting->state.version != state.version) && !gave_up;
}

std::optional<uint64_t> Viewer::noteRefusal(TimePoint now) {
    ++untold_refusals_;
    if (!refusal_lines_.take(now)) {
        return {};
    }
    return std::exchange(untold_refusals_, 0);
}

} // namespace froxel::stream

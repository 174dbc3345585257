#include "stream/viewer.h"

#include <algorithm>
#include <utility>

namespace froxel::stream {

Viewer::Viewer(const ViewerNews& first, std::shared_ptr<FramePipeline> its_pipeline)
    : sink(first.sink), pipeline(std::move(its_pipeline)), state(*first.state),
      beside(!first.account) {}

void Viewer::noteCompiling(bool compiles, TimePoint now) {
    constexpr std::chrono::milliseconds kNoticed{300};
    if (!compiles) {
        compiling_since.reset();
    } else if (!compiling_since) {
        compiling_since = now;
    }
    const bool tells = compiling_since && now - *compiling_since >= kNoticed;
    if (std::exchange(told_compiling, tells) != tells) {
        if (const auto told = sink.lock()) {
            told->compiling(tells);
        }
    }
}

std::optional<TimePoint> Viewer::wantsFrameAt() const {
    if (leaving || blocked) {
        return {};
    }
    if (left) {
        return ask_again;
    }
    if (moves()) {
        return std::max(paced_until, ask_again);
    }
    const auto due = refineNext();
    return due ? std::optional(std::max(due->at, ask_again)) : std::nullopt;
}

std::optional<session::RefinementSchedule::Due> Viewer::refineNext() const {
    // A comparison's sides are single frames, so that they are what their settings say.
    const uint32_t most_samples = state.comparison ? 1 : settings::kMeanSamples;
    return refinement.next(state.delivery.refine, delivery, state.settings, most_samples);
}

bool Viewer::beginsMean() const {
    const auto due = built || left || moves() ? std::nullopt : refineNext();
    return due && due->sample == 0 && due->sample_count > 1;
}

uint64_t Viewer::meanBytes() const {
    return amid_samples ? render::SampleMean::memoryBytes(state.settings.size) : mean.memoryBytes();
}

void Viewer::dropMean() {
    mean = {};
    amid_samples = false;
}

bool Viewer::addSample(const BegunFrame& frame, PixelLease& pixels) {
    if (frame.sample == 0) {
        mean = {};
    }
    // One was lost, or something else was asked for: all are drawn again.
    if (mean.count() != frame.sample || frame.state.version != state.version) {
        return false;
    }
    mean.add(pixels.view());
    if (!frame.isLastSample()) {
        return false;
    }
    PixelView view = pixels.view();
    auto rgba8 = mean.take();
    view.data = rgba8.data();
    view.stride_bytes = size_t{4} * view.width_px;
    // Other outputs are the last sample's.
    pixels = owningLease(view, std::pair(std::move(rgba8), std::move(pixels)));
    return true;
}

session::Delivered
Viewer::nextDelivered(const std::optional<session::RefinementSchedule::Due>& due) const {
    session::Delivery limits = delivery;
    const session::Relief relief = rate_keeper.relief();
    limits.scale = std::min(limits.scale, relief.scale);
    limits.geometry_error_px = state.comparison ? 0 : relief.geometry_error_px;
    session::Delivered with = session::delivered(
        state.encoding, limits, due ? due->stage : session::Refinement::kInteractive);
    with.scale = std::min(with.scale, affordable.scale());
    return with;
}

// The same state at the same time, whatever was asked for meanwhile.
std::shared_ptr<BegunFrame> Viewer::buildRight(TimePoint now) const {
    auto right = std::make_shared<BegunFrame>(
        BegunFrame{left->id, left->record, left->state, left->started, begun_count + 1});
    right->began = now;
    right->left = left;
    return right;
}

std::shared_ptr<BegunFrame> Viewer::build(session::SessionId id, TimePoint now) {
    if (left && left->state.scene != state.scene) {
        left.reset();
        changed = true;
    }
    if (built && built->state.version != state.version && !gave_up && !built->left) {
        gave_up = true;
        built.reset();
    } else if (built && built->state.scene != state.scene) {
        built.reset();
    }
    if (no_room_for && *no_room_for != state.settings.size) {
        no_room_for.reset();
        affordable.forgetRoom();
    }
    if (!built && left) {
        built = buildRight(now);
    }
    if (!built) {
        built = std::make_shared<BegunFrame>(BegunFrame{id, {}, state, now, begun_count + 1});
        built->began = now;
        session::FrameRecord& record = built->record;
        record.applied = state.applied;
        const auto due = moves() ? std::nullopt : refineNext();
        record.delivered = nextDelivered(due);
        if (due) {
            built->sample = due->sample;
            built->sample_count = due->sample_count;
        }
        record.time_s = state.light_clock.secondsAt(now);
        record.animation_time_s = state.playback.timeAt(session::SessionState::secondsOf(now));
        record.camera = state.cameraAt(now);
        if (state.followed) {
            record.followed = record.camera;
        }
        if (!submitted || submitted->applied != state.applied) {
            record.queue_us = Microseconds(now - arrived).count();
        }
    }
    return built;
}

void Viewer::noteBegun(const std::shared_ptr<BegunFrame>& begun, TimePoint now) {
    const BegunFrame& frame = *begun;
    const session::Delivered& with = frame.record.delivered;
    const bool limited =
        with.scale < 1 || with.geometry_error_px > 0 || with.encoding != frame.state.encoding;
    left = frame.isLeftSide() ? begun : nullptr;
    if (!left) {
        refinement.onBegun(with.refinement, limited);
    }
    amid_samples = frame.sample_count > 1 && !frame.isLastSample();
    if (moves() && !left) {
        paced_until = now + std::chrono::duration_cast<Clock::duration>(delivery.min_interval);
    }
    if (frame.left) {
        right_number = frame.number;
    }
    changed = frame.state.version != state.version;
    submitted = frame.state;
    shown_at = frame.started;
    ++under_way;
    ++started;
    ++begun_count;
}

void Viewer::endComparison() {
    // So many pictures are under way at most, and leave in order.
    if (right_source && begun_count >= right_number + FramePipeline::kCapacity) {
        right_source.reset();
    }
}

bool Viewer::hasRoom() const {
    const auto& next = left ? right_source : source;
    const bool has_source =
        next == nullptr || (source_scene == state.scene ? next->canBegin() : under_way == 0);
    return started < granted && under_way + pipeline->size() < FramePipeline::kCapacity &&
           has_source;
}

bool Viewer::waitsInVain() const {
    if (leaving || blocked) {
        return true;
    }
    if (waiting->left) {
        return false; // half of the picture is there
    }
    const bool taken_back = granted < started; // it paused
    return (taken_back || waiting->state.version != state.version) && !gave_up;
}

bool Viewer::shrink(const Error& error) {
    const bool first = !drawn || drawn->scene != state.scene;
    if (!first && error.code == ErrorCode::kCapacity &&
        drawn->settings.size == state.settings.size && affordable.onNoRoom(drawn_scale)) {
        no_room_for = state.settings.size;
        return true;
    }
    return !beside && error.code == ErrorCode::kTooLong &&
           affordable.onTooLong(error.too_large_by, first);
}

std::optional<uint64_t> Viewer::noteRefusal(TimePoint now) {
    ++untold_refusals_;
    if (!refusal_lines_.take(now)) {
        return {};
    }
    return std::exchange(untold_refusals_, 0);
}

} // namespace froxel::stream

#include "core/text.h"
#include "encode/memory.h"
#include "session/render_scale.h"
#include "session/settings.h"
#include "stream/render_loop.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace froxel::stream {

using session::SessionId;

namespace {

// A further piece is handed over while those on the device are expected to take less than this, so
// that it is never idle; whoever comes then does not wait for a second long piece.
constexpr Seconds kAhead{0.02};

// How often a view whose shaders are being made is asked whether it can begin.
constexpr std::chrono::milliseconds kVariantsPoll{20};

// Others wait meanwhile. What was asked for tells whoever mends it where to look.
constexpr Seconds kLongStep{1};

void warnOfLongStep(std::string_view step,
                    Seconds took,
                    SessionId id,
                    const session::SessionState& state) {
    if (took < kLongStep) {
        return;
    }
    const view::Size& size = state.settings.size;
    const view::GridSize& grid = state.settings.grid.size;
    spdlog::warn("event=long_step step={} seconds={:.2f} session={} size={}x{} grid={}x{}x{} "
                 "placed={} settings={}",
                 step, took.count(), id, size.width_px, size.height_px, grid.x, grid.y, grid.z,
                 state.settings.lights.placed.lights().size(),
                 logValue(session::unusualSettings(state), 1000));
}

[[nodiscard]] bool isThisPictureAlone(const Error& error) {
    return error.code == ErrorCode::kCapacity || error.code == ErrorCode::kUnsupported;
}

} // namespace

bool RenderLoop::deviceTakesMore() const {
    Seconds ahead{0};
    for (const Piece& piece : submitted_) {
        ahead += piece.charged;
    }
    return submitted_.empty() || (submitted_.size() < source_->depth() && ahead < kAhead);
}

// Every moment of this thread is charged to one viewer at most: what a step took begins where the
// one before it ended.
Seconds RenderLoop::spentSince(TimePoint begin) {
    const TimePoint now = Clock::now();
    return now - std::max(begin, std::exchange(accounted_, now));
}

bool RenderLoop::startNext() {
    const TimePoint now = Clock::now();
    const auto id = scheduler_.next(now);
    if (!id) {
        return false;
    }
    scheduler_.onStarted(*id);
    Viewer& viewer = *viewers_.at(*id);
    if (viewer.waiting || beginFrame(*id, viewer, now)) {
        submitPiece(viewer);
    }
    return true;
}

bool RenderLoop::beginFrame(SessionId id, Viewer& viewer, TimePoint now) {
    const session::Delivered with = viewer.nextDelivered();
    const auto work = beginWork(viewer, with, now);
    const Seconds host = spentSince(now);
    scheduler_.charge(id, host);
    options_.on_begun(host);
    warnOfLongStep("begin", host, id, viewer.state);
    if (!work) {
        if (!isThisPictureAlone(work.error())) {
            throw StartupError(work.error());
        }
        scheduler_.onFrame(id, now); // a refused one takes the host's time, too
        refuse(id, viewer, work.error());
        return false;
    }
    if (work->piece_count == 0) {
        viewer.ask_again = now + kVariantsPoll;
        return false;
    }
    scheduler_.onFrame(id, now);

    auto frame = std::make_shared<BegunFrame>(BegunFrame{id, {}, viewer.state, now});
    frame->cost = host;
    frame->piece_count = work->piece_count;
    const auto typical = viewer.frame_cost.value();
    const Seconds known = typical ? *typical : typical_cost_.value().value_or(Seconds(0));
    frame->piece_estimate =
        (work->estimate > Seconds(0) ? work->estimate : known) / work->piece_count;
    frame->record.frame_id = ++viewer.last_frame_id;
    frame->record.applied = viewer.state.applied;
    frame->record.delivered = with;
    frame->record.time_s = viewer.state.light_clock.secondsAt(now);
    if (!viewer.submitted || viewer.submitted->applied != viewer.state.applied) {
        frame->record.queue_us = Microseconds(now - viewer.arrived).count();
    }
    viewer.noteBegun(with, now);
    viewer.waiting = std::move(frame);
    return true;
}

Result<FrameWork>
RenderLoop::beginWork(Viewer& viewer, const session::Delivered& with, TimePoint now) {
    if (!viewer.source) {
        auto source = source_->makeView();
        if (!source) {
            return source.error();
        }
        viewer.source = std::move(*source);
    }
    view::ViewSettings settings = viewer.state.settings;
    settings.size = session::scaled(settings.size, with.scale);
    // A refined still leaves the encoder of video as it is.
    const uint64_t encoding_bytes =
        std::max(encode::memoryBytes(with.encoding, settings.size),
                 encode::memoryBytes(viewer.state.encoding, settings.size));
    return viewer.source->begin(settings, viewer.state.light_clock.secondsAt(now), encoding_bytes);
}

void RenderLoop::submitPiece(Viewer& viewer) {
    BegunFrame& frame = *viewer.waiting;
    if (const auto submitted = viewer.source->submitPiece(); !submitted) {
        throw StartupError(submitted.error());
    }
    scheduler_.charge(frame.id, frame.piece_estimate);
    submitted_.push_back({viewer.waiting, frame.piece_estimate, Clock::now()});
    ++frame.on_device;
    if (++frame.submitted_count == frame.piece_count) {
        viewer.waiting.reset();
    }
}

void RenderLoop::abandon(Viewer& viewer) {
    BegunFrame& frame = *viewer.waiting;
    viewer.source->abandon();
    ++options_.fates->given_up;
    viewer.gave_up = true;
    viewer.changed = true;
    end(viewer, frame);
    if (frame.on_device == 0) {
        --viewer.under_way;
    }
    viewer.waiting.reset();
}

// It comes to no picture: its credit is free again.
void RenderLoop::end(Viewer& viewer, BegunFrame& frame) {
    frame.over = true;
    --viewer.started;
    viewer.submitted.reset();
}

void RenderLoop::refuse(SessionId id, Viewer& viewer, const Error& error) {
    const view::Size& size = viewer.state.settings.size;
    if (const auto count = viewer.noteRefusal(Clock::now())) {
        spdlog::warn("event=picture_refused session={} size={}x{} count={} reason={}", id,
                     size.width_px, size.height_px, *count, logValue(error.message));
    }
    viewer.blocked = true;
    if (const auto sink = viewer.sink.lock()) {
        sink->refuse(error, viewer.state, viewer.drawn);
    }
}

void RenderLoop::finishOldest() {
    const Piece piece = std::move(submitted_.front());
    submitted_.pop_front();
    BegunFrame& frame = *piece.frame;
    Viewer& viewer = *viewers_.at(frame.id);
    auto collected = viewer.source->collect();
    if (!collected && collected.error().code != ErrorCode::kCapacity) {
        throw StartupError(collected.error());
    }
    const Seconds cost = spentSince(piece.submitted);
    options_.on_piece(cost);
    warnOfLongStep("piece", cost, frame.id, frame.state);
    scheduler_.onFinished(frame.id, cost - piece.charged, accounted_);
    frame.cost += cost;
    frame.longest_piece = std::max(frame.longest_piece, cost);
    --frame.on_device;
    if (!frame.over) {
        finishPiece(viewer, frame, std::move(collected));
    }
    if (frame.on_device == 0 && viewer.waiting != piece.frame) {
        --viewer.under_way;
    }
}

void RenderLoop::finishPiece(Viewer& viewer, BegunFrame& frame, Result<Collected> collected) {
    if (collected && collected->outcome == Collected::Outcome::kPiece) {
        return;
    }
    if (viewer.waiting.get() == &frame) {
        viewer.waiting.reset(); // the view has given up the rest
    }
    if (collected && collected->frame) {
        finishFrame(viewer, frame, std::move(*collected->frame));
        return;
    }
    end(viewer, frame);
    if (viewer.leaving) {
        return;
    }
    if (collected || frame.state.version != viewer.state.version) {
        viewer.changed = true; // drawn again, or as the viewer has asked for meanwhile
    } else if (!viewer.blocked) {
        refuse(frame.id, viewer, collected.error());
    }
}

void RenderLoop::finishFrame(Viewer& viewer, BegunFrame& frame, SourceFrame drawn) {
    const TimePoint now = Clock::now();
    typical_cost_.add(frame.cost);
    viewer.frame_cost.add(frame.cost);
    viewer.piece_cost = frame.longest_piece;
    viewer.gave_up = false;
    {
        const std::lock_guard lock(admission_mutex_);
        admission_.onFrame(frame.id, frame.cost, now);
    }
    viewer.drawn = frame.state;
    ++options_.fates->rendered;
    const session::Delivered& with = frame.record.delivered;
    if (with.refinement == session::Refinement::kInteractive) {
        const double target_hz = viewer.state.delivery.target_fps;
        demand_.onFrame(frame.id, frame.cost, target_hz, now);
        if (target_hz > 0) {
            // As if it had the device to itself, at this much a frame.
            const Seconds shared(demand_.total(now) / target_hz);
            viewer.render_scale.onFrame(std::max(frame.cost, shared), with.scale, now);
        }
    }
    if (viewer.leaving) {
        ++options_.fates->viewer_gone;
        return;
    }
    session::FrameRecord& record = frame.record;
    const PixelView& pixels = drawn.pixels.view();
    record.width_px = pixels.width_px;
    record.height_px = pixels.height_px;
    record.render_us = Microseconds(now - frame.started).count();
    record.stats = std::move(drawn.stats);
    viewer.pipeline->push({std::move(drawn.pixels), frame.state.key_requests, std::move(record),
                           std::max(frame.cost, options_.min_frame_interval), now});
}

} // namespace froxel::stream

#include "stream/render_loop.h"

#include "core/text.h"
#include "core/thread_name.h"
#include "session/refinement.h"
#include "session/render_scale.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <malloc.h>
#include <utility>

namespace froxel::stream {

using session::SessionId;
using session::SessionState;

struct RenderLoop::Viewer {
    Viewer(const ViewerNews& first, std::shared_ptr<FramePipeline> its_pipeline)
        : sink(first.sink), account(first.account), pipeline(std::move(its_pipeline)),
          state(*first.state) {}

    std::weak_ptr<session::FrameSink> sink;
    session::Account account;
    std::shared_ptr<FramePipeline> pipeline;
    std::unique_ptr<ViewSource> source; // made with the first frame
    SessionState state;
    TimePoint arrived{};
    std::optional<SessionState> submitted; // what the device was last given
    std::optional<SessionState> drawn;     // what it last made a picture of
    uint64_t last_frame_id = 0;
    uint64_t started = 0; // frames, without those lost on the way
    uint64_t granted = 0;
    uint32_t on_device = 0;
    session::Delivery delivery;
    session::RenderScale render_scale;
    session::RefinementSchedule refinement;
    TimePoint paced_until{}; // by the delivery's interval
    bool changed = true;
    bool blocked = false; // this state was refused; waits for another
    bool leaving = false;

    [[nodiscard]] bool idle() const { return on_device == 0 && pipeline->size() == 0; }
    [[nodiscard]] bool moves() const { return changed || state.animating(); }
    // When the next frame is due, as far as that is up to this viewer; none: nothing is to be
    // drawn.
    [[nodiscard]] std::optional<TimePoint> wantsFrameAt() const {
        if (leaving || blocked) {
            return {};
        }
        if (moves()) {
            return paced_until;
        }
        const auto due = refineNext();
        return due ? std::optional(due->at) : std::nullopt;
    }
    [[nodiscard]] std::optional<session::RefinementSchedule::Due> refineNext() const {
        return refinement.next(state.delivery.refine, delivery, state.settings.size);
    }
    [[nodiscard]] session::Delivered nextDelivered() const {
        const auto due = moves() ? std::nullopt : refineNext();
        session::Delivery limits = delivery;
        limits.scale = std::min(limits.scale, render_scale.scale());
        return session::delivered(state.encoding, limits,
                                  due ? due->stage : session::Refinement::kInteractive);
    }
    void noteBegun(const session::Delivered& with, TimePoint now) {
        const bool limited = with.scale < 1 || with.encoding != state.encoding;
        refinement.onBegun(with.refinement, limited);
        if (moves()) {
            const auto interval =
                std::chrono::duration_cast<Clock::duration>(delivery.min_interval);
            paced_until = now + interval;
        }
        changed = false;
    }
    [[nodiscard]] bool hasRoom() const {
        return started < granted && on_device + pipeline->size() < FramePipeline::kCapacity &&
               (source == nullptr || source->canSubmit());
    }
};

RenderLoop::RenderLoop(encode::EncodePool& pool, RenderLoopOptions options)
    : options_(std::move(options)), pool_(pool),
      mailbox_(std::make_shared<ViewerMailbox>(options_.sessions_max)),
      scheduler_(options_.min_frame_interval), thread_([this](const std::stop_token& stop) {
          nameThread("render");
          run(stop);
      }) {}

RenderLoop::~RenderLoop() {
    stop();
}

void RenderLoop::stop() {
    thread_.request_stop();
    if (thread_.joinable()) {
        thread_.join();
    }
}

Result<SessionId> RenderLoop::join(std::weak_ptr<session::FrameSink> sink,
                                   const SessionState& state,
                                   const session::Account& account,
                                   TimePoint now) {
    const std::lock_guard lock(admission_mutex_);
    if (auto fits = admission_.check(now); !fits) {
        return fits.error();
    }
    auto id = mailbox_->join(std::move(sink), state, account, now);
    if (id) {
        admission_.add(*id, now);
    }
    return id;
}

Result<void> RenderLoop::admits(const session::Account& /*account*/, TimePoint now) const {
    const std::lock_guard lock(admission_mutex_);
    if (auto fits = admission_.check(now); !fits) {
        return fits;
    }
    return mailbox_->check();
}

void RenderLoop::setMinRate(double min_rate_hz, std::optional<Seconds> frame_cost) {
    const std::lock_guard lock(admission_mutex_);
    admission_.setMinRate(min_rate_hz, frame_cost);
}

void RenderLoop::update(SessionId id, const SessionState& state, TimePoint arrived) {
    mailbox_->update(id, state, arrived);
}

void RenderLoop::grant(SessionId id, uint64_t frame_total) {
    mailbox_->grant(id, frame_total);
}

void RenderLoop::setDelivery(SessionId id, const session::Delivery& delivery) {
    mailbox_->setDelivery(id, delivery);
}

void RenderLoop::leave(SessionId id) {
    {
        const std::lock_guard lock(admission_mutex_);
        admission_.remove(id);
    }
    mailbox_->leave(id);
}

void RenderLoop::run(const std::stop_token& stop) {
    try {
        source_ = options_.make_source();
        serve(stop);
        drain();
    } catch (const StartupError& error) {
        fail({error.code(), error.what()});
    } catch (const std::exception& error) {
        fail({ErrorCode::kDevice, error.what()});
    }
    source_.reset();
}

void RenderLoop::serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        options_.heartbeat->beat(Clock::now());
        takeNews();
        if (submitted_.size() < source_->depth() && startNext()) {
            continue;
        }
        if (!submitted_.empty()) {
            finishOldest();
            continue;
        }
        options_.heartbeat->rest();
        mailbox_->wait(stop, nextWake());
    }
    options_.heartbeat->rest();
}

std::optional<TimePoint> RenderLoop::nextWake() const {
    const auto due = scheduler_.nextDue();
    return due && refine_at_ ? std::min(due, refine_at_) : due ? due : refine_at_;
}

void RenderLoop::takeState(Viewer& viewer, const ViewerNews& news) {
    const bool differs = news.state->version != viewer.state.version;
    viewer.changed = viewer.changed || differs;
    viewer.blocked = viewer.blocked && !differs;
    viewer.state = *news.state;
    viewer.arrived = news.arrived;
    viewer.render_scale.setTarget(viewer.state.delivery.target_fps);
    if (differs) {
        viewer.refinement.onChange(news.arrived);
    }
}

void RenderLoop::takeNews() {
    for (ViewerNews& news : mailbox_->take()) {
        auto& entry = viewers_[news.id];
        if (!entry) {
            auto pipeline =
                std::make_shared<FramePipeline>(pool_, news.id, news.sink, options_.fates,
                                                [mailbox = mailbox_] { mailbox->wake(); });
            entry = std::make_unique<Viewer>(news, std::move(pipeline));
            entry->refinement.onChange(news.arrived);
            scheduler_.add(news.id);
        }
        Viewer& viewer = *entry;
        viewer.granted = news.granted;
        viewer.leaving = news.left;
        viewer.delivery = news.delivery;
        if (news.state) {
            takeState(viewer, news);
            scheduler_.onInput(news.id, news.arrived);
        }
    }
    const TimePoint now = Clock::now();
    refine_at_.reset();
    const bool had_viewers = !viewers_.empty();
    for (auto viewer = viewers_.begin(); viewer != viewers_.end();) {
        if (viewer->second->leaving && viewer->second->idle()) {
            scheduler_.remove(viewer->first);
            demand_.remove(viewer->first);
            viewer = viewers_.erase(viewer);
        } else {
            updateReadiness(viewer->first, *viewer->second, now);
            ++viewer;
        }
    }
    if (had_viewers && viewers_.empty()) {
        // Shaders are compiled in pieces of all sizes, whose holes the heap keeps: a third of
        // resident memory after a while. It takes some tenths of a second; nobody waits for it now.
        malloc_trim(0);
    }
}

void RenderLoop::updateReadiness(SessionId id, Viewer& viewer, TimePoint now) {
    const FramePipeline::Losses losses = viewer.pipeline->takeLosses();
    viewer.started -= losses.count;
    viewer.changed = viewer.changed || losses.retry;
    const auto due = viewer.hasRoom() ? viewer.wantsFrameAt() : std::nullopt;
    scheduler_.setReady(id, due && *due <= now);
    if (due && *due > now) {
        refine_at_ = refine_at_ ? std::min(*refine_at_, *due) : *due;
    }
}

bool RenderLoop::startNext() {
    const TimePoint now = Clock::now();
    const auto id = scheduler_.next(now);
    if (!id) {
        return false;
    }
    Viewer& viewer = *viewers_.at(*id);
    const session::Delivered with = viewer.nextDelivered();
    const auto started = submit(viewer, with, now);
    if (!started) {
        const ErrorCode code = started.error().code;
        if (code != ErrorCode::kCapacity && code != ErrorCode::kUnsupported) {
            throw StartupError(started.error());
        }
        refuse(*id, viewer, started.error());
        return true;
    }
    scheduler_.onStarted(*id, now);

    Submitted frame{*id, {}, viewer.state, now};
    frame.record.frame_id = ++viewer.last_frame_id;
    frame.record.applied = viewer.state.applied;
    frame.record.delivered = with;
    frame.record.time_s = viewer.state.light_clock.secondsAt(now);
    if (!viewer.submitted || viewer.submitted->applied != viewer.state.applied) {
        frame.record.queue_us = Microseconds(now - viewer.arrived).count();
    }
    submitted_.push_back(std::move(frame));
    viewer.submitted = viewer.state;
    viewer.noteBegun(with, now);
    ++viewer.on_device;
    ++viewer.started;
    return true;
}

Result<void> RenderLoop::submit(Viewer& viewer, const session::Delivered& with, TimePoint now) {
    if (!viewer.source) {
        auto source = source_->makeView();
        if (!source) {
            return source.error();
        }
        viewer.source = std::move(*source);
    }
    view::ViewSettings settings = viewer.state.settings;
    settings.size = session::scaled(settings.size, with.scale);
    return viewer.source->submit(settings, viewer.state.light_clock.secondsAt(now));
}

void RenderLoop::refuse(SessionId id, Viewer& viewer, const Error& error) {
    const view::Size& size = viewer.state.settings.size;
    spdlog::warn("event=picture_refused session={} size={}x{} reason={}", id, size.width_px,
                 size.height_px, logValue(error.message));
    viewer.blocked = true;
    if (const auto sink = viewer.sink.lock()) {
        sink->refuse(error, viewer.state, viewer.drawn);
    }
}

void RenderLoop::finishOldest() {
    Submitted frame = std::move(submitted_.front());
    submitted_.pop_front();
    Viewer& viewer = *viewers_.at(frame.id);
    --viewer.on_device;
    auto collected = viewer.source->collect();
    if (!collected) {
        giveUp(viewer, frame, collected.error());
        return;
    }
    const TimePoint now = Clock::now();
    // The device works on one frame at a time: what this one took begins where the last one ended.
    const Seconds cost = now - std::max(frame.started, last_finish_);
    last_finish_ = now;
    scheduler_.onFinished(frame.id, cost);
    {
        const std::lock_guard lock(admission_mutex_);
        admission_.onFrame(frame.id, cost, now);
    }
    viewer.drawn = frame.state;
    ++options_.fates->rendered;
    const session::Delivered& with = frame.record.delivered;
    if (with.refinement == session::Refinement::kInteractive) {
        const double target_hz = viewer.state.delivery.target_fps;
        demand_.onFrame(frame.id, cost, target_hz, now);
        if (target_hz > 0) {
            // As if it had the device to itself, at this much a frame.
            const Seconds shared(demand_.total(now) / target_hz);
            viewer.render_scale.onFrame(std::max(cost, shared), with.scale, now);
        }
    }
    if (viewer.leaving) {
        ++options_.fates->viewer_gone;
        return;
    }
    session::FrameRecord& record = frame.record;
    const PixelView& pixels = collected->pixels.view();
    record.width_px = pixels.width_px;
    record.height_px = pixels.height_px;
    record.render_us = Microseconds(now - frame.started).count();
    record.stats = std::move(collected->stats);
    viewer.pipeline->push({std::move(collected->pixels), frame.state.key_requests,
                           std::move(record), std::max(cost, options_.min_frame_interval), now});
}

void RenderLoop::giveUp(Viewer& viewer, const Submitted& frame, const Error& error) {
    if (error.code != ErrorCode::kCapacity) {
        throw StartupError(error);
    }
    --viewer.started;
    if (viewer.leaving) {
        return;
    }
    if (frame.state.version != viewer.state.version) {
        viewer.changed = true; // the viewer has asked for something else, which may fit
    } else if (!viewer.blocked) {
        refuse(frame.id, viewer, error);
    }
}

void RenderLoop::fail(const Error& error) {
    failed_ = true;
    options_.heartbeat->rest();
    mailbox_->close(error);
    takeNews();
    for (auto& [id, viewer] : viewers_) {
        if (const auto sink = viewer->sink.lock()) {
            sink->deviceLost(error);
        }
    }
    drain();
    options_.on_failure(error);
}

// Views and their pixels go on this thread, after the encoders are done with them.
void RenderLoop::drain() {
    while (!submitted_.empty()) {
        Viewer& viewer = *viewers_.at(submitted_.front().id);
        --viewer.on_device;
        submitted_.pop_front();
        if (const auto collected = viewer.source->collect(); !collected && !failed_) {
            spdlog::error("event=frame_lost reason={}", logValue(collected.error().message));
        }
    }
    const std::stop_token never;
    while (!std::all_of(viewers_.begin(), viewers_.end(),
                        [](const auto& entry) { return entry.second->idle(); })) {
        mailbox_->wait(never, std::nullopt);
    }
    viewers_.clear();
}

} // namespace froxel::stream

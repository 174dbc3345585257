#include "stream/render_loop.h"

#include "core/keep_for_good.h"
#include "core/thread_name.h"

#include <algorithm>
#include <malloc.h>
#include <utility>

namespace froxel::stream {

using session::SessionId;
using session::SessionState;

namespace {

// Of a viewer that has not drawn yet: long enough that others are waited for.
constexpr Seconds kUnknownPiece{0.1};

} // namespace

RenderLoop::RenderLoop(encode::EncodePool& pool, RenderLoopOptions options)
    : options_(std::move(options)), pool_(pool), mailbox_(std::make_shared<ViewerMailbox>()),
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
    if (auto fits = admission_.check(account, now); !fits) {
        return fits.error();
    }
    auto id = mailbox_->join(std::move(sink), state, account, now);
    if (id) {
        admission_.add(*id, account, now);
    }
    return id;
}

Result<void> RenderLoop::admits(const session::Account& account, TimePoint now) const {
    const std::lock_guard lock(admission_mutex_);
    if (auto fits = admission_.check(account, now); !fits) {
        return fits;
    }
    return mailbox_->check();
}

void RenderLoop::setMinRate(double min_rate_hz, std::optional<Seconds> frame_cost) {
    const std::lock_guard lock(admission_mutex_);
    admission_.setMinRate(min_rate_hz, frame_cost);
}

double RenderLoop::load(TimePoint now) const {
    const std::lock_guard lock(admission_mutex_);
    return admission_.load(now);
}

void RenderLoop::update(SessionId id, const SessionState& state, TimePoint arrived) {
    mailbox_->update(id, state, arrived);
}

void RenderLoop::grant(SessionId id, uint64_t frame_total) {
    {
        const std::lock_guard lock(admission_mutex_);
        admission_.setTakesFrames(id, frame_total > 0, Clock::now());
    }
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
        source_->makeVariantsInBackground();
        serve(stop);
        drain();
    } catch (const StartupError& error) {
        fail({error.code(), error.what()});
    } catch (const std::exception& error) {
        fail({ErrorCode::kDevice, error.what()});
    }
    source_.reset(); // none after a failure
}

void RenderLoop::serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        options_.heartbeat->beat(Clock::now());
        takeNews();
        if (deviceTakesMore() && startNext()) {
            continue;
        }
        if (!submitted_.empty()) {
            finishOldest();
            continue;
        }
        options_.heartbeat->rest();
        const TimePoint idle_since = Clock::now();
        mailbox_->wait(stop, nextWake());
        scheduler_.onIdle(spentSince(idle_since));
    }
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

void RenderLoop::readNews() {
    for (const ViewerNews& news : mailbox_->take()) {
        auto& entry = viewers_[news.id];
        if (!entry) {
            auto pipeline =
                std::make_shared<FramePipeline>(pool_, news.id, news.sink, options_.fates,
                                                [mailbox = mailbox_] { mailbox->wake(); });
            entry = std::make_unique<Viewer>(news, std::move(pipeline));
            entry->refinement.onChange(news.arrived);
            scheduler_.add(news.id, news.account);
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
}

void RenderLoop::takeNews() {
    readNews();
    const TimePoint now = Clock::now();
    refine_at_.reset();
    const bool had_viewers = !viewers_.empty();
    for (auto entry = viewers_.begin(); entry != viewers_.end();) {
        Viewer& viewer = *entry->second;
        chargeEncoding(entry->first, viewer); // the last picture's as well
        if (viewer.waiting && viewer.waitsInVain()) {
            abandon(viewer);
        }
        if (viewer.leaving && viewer.idle()) {
            scheduler_.remove(entry->first);
            demand_.remove(entry->first);
            entry = viewers_.erase(entry);
        } else {
            updateReadiness(entry->first, viewer, now);
            ++entry;
        }
    }
    if (had_viewers && viewers_.empty()) {
        // Shaders are compiled in pieces of all sizes, whose holes the heap keeps: a third of
        // resident memory after a while. It takes some tenths of a second; nobody waits for it now.
        malloc_trim(0);
    }
}

void RenderLoop::chargeEncoding(SessionId id, Viewer& viewer) {
    const Seconds encoding = viewer.pipeline->takeWork();
    if (source_->isHost()) {
        scheduler_.charge(id, encoding / core_count_);
    }
}

void RenderLoop::updateReadiness(SessionId id, Viewer& viewer, TimePoint now) {
    const FramePipeline::Losses losses = viewer.pipeline->takeLosses();
    viewer.started -= losses.count;
    viewer.changed = viewer.changed || losses.retry;
    using Ready = FrameScheduler::Ready;
    if (viewer.waiting) {
        scheduler_.setReady(id, Ready::kPiece, viewer.waiting->piece_estimate, now);
        return;
    }
    const auto due = viewer.hasRoom() ? viewer.wantsFrameAt() : std::nullopt;
    const bool ready = due && *due <= now;
    const Seconds piece = viewer.drawn ? viewer.piece_cost : kUnknownPiece;
    scheduler_.setReady(id, ready ? Ready::kFrame : Ready::kNo, piece, now);
    if (due && *due > now) {
        refine_at_ = refine_at_ ? std::min(*refine_at_, *due) : *due;
    }
}

// Whoever joined meanwhile is told too. The device is asked nothing more and nothing that it may
// still use is freed: after a wait that ended in time it may yet write there.
void RenderLoop::fail(const Error& error) {
    mailbox_->close(error);
    options_.on_failure(error);
    readNews();
    for (auto& [id, viewer] : viewers_) {
        if (const auto sink = viewer->sink.lock()) {
            sink->deviceLost(error);
        }
        keepForGood(std::move(viewer->source));
        viewer->under_way = 0;
    }
    keepForGood(std::move(source_));
    submitted_.clear();
    finishPictures();
}

void RenderLoop::drain() {
    for (auto& [id, viewer] : viewers_) {
        if (viewer->waiting) {
            abandon(*viewer);
        }
    }
    while (!submitted_.empty()) {
        options_.heartbeat->beat(Clock::now());
        finishOldest();
    }
    finishPictures();
}

// Views and their pixels go on this thread, after the encoders are done with them.
void RenderLoop::finishPictures() {
    options_.heartbeat->rest();
    const std::stop_token never;
    while (!std::all_of(viewers_.begin(), viewers_.end(),
                        [](const auto& entry) { return entry.second->idle(); })) {
        mailbox_->wait(never, std::nullopt);
    }
    viewers_.clear();
}

} // namespace froxel::stream

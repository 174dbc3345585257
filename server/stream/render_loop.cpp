#include "stream/render_loop.h"

#include "core/keep_for_good.h"
#include "core/text.h"
#include "core/thread_name.h"
#include "encode/memory.h"
#include "session/rate_keeper.h"
#include "session/settings.h"
#include "settings/samples.h"
#include "stream/frame_cost.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <malloc.h>
#include <string_view>
#include <utility>

namespace froxel::stream {

using session::SessionId;
using session::SessionState;

namespace {

// Of a viewer that has not drawn yet: long enough that others are waited for.
constexpr Seconds kUnknownPiece{0.1};

// A further piece is handed over while those on the device are expected to take less than this, so
// that it is never idle; whoever comes then does not wait for a second long piece.
constexpr Seconds kAhead{0.02};

// How often a view whose shaders are being made is asked whether it can begin.
constexpr std::chrono::milliseconds kVariantsPoll{20};

// Others wait meanwhile. What was asked for tells whoever mends it where to look.
constexpr Seconds kLongStep{0.5};

void warnOfLongStep(std::string_view step,
                    Seconds took,
                    Seconds expected,
                    SessionId id,
                    const session::SessionState& state) {
    if (took < kLongStep) {
        return;
    }
    const settings::Size& size = state.settings.size;
    const settings::GridSize& grid = state.settings.grid.size;
    spdlog::warn("event=long_step step={} seconds={:.2f} expected={:.2f} session={} size={}x{} "
                 "grid={}x{}x{} placed={} settings={}",
                 step, took.count(), expected.count(), id, size.width_px, size.height_px, grid.x,
                 grid.y, grid.z, state.settings.lights.placed.lights().size(),
                 logValue(session::unusualSettings(state), 1000));
}

// Whether its viewers may draw its picture from a camera near its own. A picture that rests has the
// depth of the one before; a camera that is orthographic shows no parallax.
bool sendsDepth(const BegunFrame& frame) {
    return frame.state.sends_depth && !frame.state.comparison &&
           frame.record.delivered.refinement == session::Refinement::kInteractive &&
           frame.record.camera.projection == settings::Projection::kPerspective &&
           !settings::replacesPicture(frame.state.settings.debug.view);
}

[[nodiscard]] bool isThisPictureAlone(const Error& error) {
    return error.code == ErrorCode::kCapacity || error.code == ErrorCode::kTooLong ||
           error.code == ErrorCode::kUnsupported;
}

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

Result<SessionId> RenderLoop::joinBeside(std::weak_ptr<session::FrameSink> sink,
                                         const SessionState& state) {
    return mailbox_->join(std::move(sink), state, std::nullopt, Clock::now());
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
    priced_ = frame_cost.value_or(Seconds(0));
    priced_at_.reset();
    admission_.setMinRate(min_rate_hz, frame_cost);
}

// Something else may have kept the device busy when it was measured.
Seconds RenderLoop::newcomersCost() {
    const double pace = source_->pace();
    priced_at_ = priced_at_.value_or(pace);
    return priced_ * std::min(1.0, pace / *priced_at_);
}

void RenderLoop::setNewcomersFrame(settings::ViewSettings settings) {
    newcomers_frame_ = std::move(settings);
}

double RenderLoop::load(TimePoint now) const {
    const std::lock_guard lock(admission_mutex_);
    return admission_.load(now);
}

void RenderLoop::update(SessionId id, const SessionState& state, TimePoint arrived) {
    mailbox_->update(id, state, arrived);
}

void RenderLoop::grant(SessionId id, uint64_t frame_total) {
    mailbox_->grant(id, frame_total);
}

void RenderLoop::setTakesFrames(SessionId id, bool takes) {
    const std::lock_guard lock(admission_mutex_);
    admission_.setTakesFrames(id, takes, Clock::now());
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
        if (options_.scenes) {
            options_.scenes->end();
        }
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
        takeNews(stop);
        const auto scenes_at = options_.scenes ? options_.scenes->work(Clock::now()) : std::nullopt;
        if (deviceTakesMore() && startNext()) {
            continue;
        }
        if (!submitted_.empty()) {
            finishOldest();
            continue;
        }
        options_.heartbeat->rest();
        const TimePoint idle_since = Clock::now();
        mailbox_->wait(stop, nextWake(scenes_at));
        scheduler_.onIdle(spentSince(idle_since));
    }
}

std::optional<TimePoint> RenderLoop::nextWake(std::optional<TimePoint> scenes_at) const {
    std::optional<TimePoint> next;
    const auto ready_at =
        ready_at_.empty() ? std::nullopt : std::optional(ready_at_.begin()->first);
    for (const auto& at : {scheduler_.nextDue(), ready_at, scenes_at}) {
        next = next && at ? std::min(next, at) : next ? next : at;
    }
    return next;
}

SceneSource& RenderLoop::sourceOf(const SessionState& state) {
    return options_.scenes ? options_.scenes->sourceOf(state.scene.get()) : *source_;
}

void RenderLoop::takeState(Viewer& viewer, const ViewerNews& news) {
    const bool differs = news.state->version != viewer.state.version;
    viewer.changed = viewer.changed || differs;
    viewer.blocked = viewer.blocked && !differs;
    viewer.state = *news.state;
    viewer.arrived = news.arrived;
    viewer.rate_keeper.setTarget(viewer.state.delivery.target_fps,
                                 sourceOf(viewer.state).hasDetailLevels());
    if (differs) {
        viewer.refinement.onChange(news.arrived);
        viewer.dropMean();
    }
}

void RenderLoop::readNews() {
    for (const ViewerNews& news : mailbox_->take()) {
        auto& entry = viewers_[news.id];
        if (!entry) {
            auto pipeline = std::make_shared<FramePipeline>(
                pool_, news.id, news.sink, options_.fates,
                [mailbox = mailbox_, id = news.id] { mailbox->noteProgress(id); });
            entry = std::make_unique<Viewer>(news, std::move(pipeline));
            entry->refinement.onChange(news.arrived);
            if (news.account) {
                watched_ = true;
                scheduler_.add(news.id, *news.account);
            } else {
                scheduler_.addBeside(news.id);
            }
        }
        Viewer& viewer = *entry;
        lookAt(news.id, viewer);
        viewer.granted = news.granted;
        viewer.leaving = news.left;
        viewer.delivery = news.delivery;
        if (news.state) {
            takeState(viewer, news);
            scheduler_.onInput(news.id, news.arrived);
        }
    }
}

void RenderLoop::takeNews(const std::stop_token& stop) {
    readNews();
    const TimePoint now = Clock::now();
    while (!ready_at_.empty() && ready_at_.begin()->first <= now) {
        const SessionId id = ready_at_.begin()->second;
        ready_at_.erase(ready_at_.begin());
        viewers_.at(id)->ready_at.reset();
        lookAt(id, *viewers_.at(id));
    }
    for (const SessionId id : std::exchange(looks_, {})) {
        look(id, now);
    }
    if (watched_ && viewers_.empty()) {
        watched_ = false;
        // Shaders are compiled in pieces of all sizes, whose holes the heap keeps: a third of
        // resident memory after a while. It takes some tenths of a second; nobody waits for it now.
        malloc_trim(0);
        priceAgain(stop);
    }
}

void RenderLoop::lookAt(SessionId id, Viewer& viewer) {
    if (!std::exchange(viewer.looked_at, true)) {
        looks_.push_back(id);
    }
}

// Lets it go, or tells the scheduler whether it is ready.
void RenderLoop::look(SessionId id, TimePoint now) {
    Viewer& viewer = *viewers_.at(id);
    viewer.looked_at = false;
    chargeEncoding(id, viewer); // the last picture's as well
    if (viewer.waiting && viewer.waitsInVain()) {
        abandon(viewer);
    }
    if (viewer.ready_at) {
        ready_at_.erase({*std::exchange(viewer.ready_at, std::nullopt), id});
    }
    if (viewer.leaving && viewer.idle()) {
        scheduler_.remove(id);
        demand_.remove(id);
        viewers_.erase(id);
        return;
    }
    updateReadiness(id, viewer, now);
    if (viewer.leaving) {
        lookAt(id, viewer); // nothing is heard of it any more
    }
}

// Its pipelines are there now, and the device's clocks and whoever else uses it may be others.
// Given up for whoever comes.
void RenderLoop::priceAgain(const std::stop_token& stop) {
    if (!newcomers_frame_) {
        return;
    }
    const auto cost = measureFrameCost(*source_, *newcomers_frame_, [&] {
        options_.heartbeat->beat(Clock::now());
        return !stop.stop_requested() && !mailbox_->hasNews();
    });
    if (cost) {
        const std::lock_guard lock(admission_mutex_);
        priced_ = *cost;
        priced_at_ = source_->pace();
        admission_.setNewcomersCost(*cost);
    } else if (cost.error().code == ErrorCode::kDevice) {
        throw StartupError(cost.error());
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
    if (viewer.meanBytes() > 0 && viewer.pauses()) { // its memory is others'
        viewer.dropMean();
        viewer.refinement.onSamplesLost();
    }
    const auto due = viewer.wantsFrameAt();
    const bool has_room = viewer.hasRoom() && (!viewer.beginsMean() || meansFit());
    const bool ready = has_room && due && *due <= now;
    const Seconds piece = viewer.drawn ? viewer.piece_cost : kUnknownPiece;
    scheduler_.setReady(id, ready ? Ready::kFrame : Ready::kNo, piece, now);
    if (due && has_room && !ready) {
        viewer.ready_at = due;
        ready_at_.emplace(*due, id);
    }
    // Others take and leave memory for means; and a slot is free without a word.
    if (due && (viewer.beginsMean() || (!has_room && viewer.started < viewer.granted))) {
        lookAt(id, viewer);
    }
}

// Whether another view may add up samples besides those that do.
bool RenderLoop::meansFit() const {
    uint64_t bytes = 0;
    for (const auto& [id, viewer] : viewers_) {
        bytes += viewer->meanBytes();
    }
    return bytes < options_.means_bytes;
}

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
    lookAt(*id, viewer);
    if (viewer.waiting || beginFrame(*id, viewer, now)) {
        submitPiece(viewer);
    }
    return true;
}

// A viewer's first frames make what it keeps, such as targets and readback slots, while a device
// that rested may be slow. Where hundreds share it, a debt of a few hundredths of a second would be
// a wait of seconds.
Seconds RenderLoop::chargeFor(const Viewer& viewer, const BegunFrame& frame, Seconds cost) const {
    constexpr uint64_t kFirstFrames = 3; // as many as a view has slots
    const bool is_first = !viewer.beside && frame.number <= kFirstFrames;
    const Seconds usual = std::max(frame.estimate, typical_cost_.value().value_or(Seconds(0)));
    return is_first && usual > Seconds(0) ? std::min(cost, usual) : cost;
}

bool RenderLoop::beginFrame(SessionId id, Viewer& viewer, TimePoint now) {
    const std::shared_ptr<BegunFrame> frame = viewer.build(id, now);
    const auto work = beginWork(viewer, *frame);
    const Seconds host = spentSince(now);
    // Whoever is first to need what all share, such as pipelines, does not pay for it: it would
    // wait for its picture until everybody has had as much.
    const bool begins_nothing = work && !work->half_built && work->piece_count == 0;
    if (!begins_nothing) {
        scheduler_.charge(id, chargeFor(viewer, *frame, host));
    }
    options_.on_begun(host);
    warnOfLongStep("begin", host, {}, id, frame->state);
    frame->cost += host;
    frame->host += host;
    if (work && work->half_built) {
        return false;
    }
    viewer.built.reset();
    if (!work) {
        if (!isThisPictureAlone(work.error())) {
            throw StartupError(work.error());
        }
        if (std::exchange(viewer.left, nullptr)) {
            viewer.changed = true;
        }
        if (viewer.shrink(work.error())) {
            return false; // begun again, smaller
        }
        scheduler_.onFrame(id, now);   // a refused one takes the host's time, too
        if (frame->sample_count > 1) { // what is shown stays
            viewer.refinement.onSamplesRefused();
        } else if (frame->state.version == viewer.state.version) { // else what came since is next
            refuse(id, viewer, work.error());
        }
        return false;
    }
    if (begins_nothing) {
        viewer.ask_again = now + kVariantsPoll;
        viewer.noteCompiling(true, now);
        return false;
    }
    viewer.noteCompiling(false, now);
    noteEstimate(viewer, *frame, *work);
    scheduler_.onFrame(id, now);
    frame->piece_count = work->piece_count;
    const auto typical = viewer.frame_cost.value();
    const Seconds known = typical ? *typical : typical_cost_.value().value_or(Seconds(0));
    frame->piece_estimate =
        (work->estimate > Seconds(0) ? work->estimate : known) / work->piece_count;
    if (frame->isLastSample() && !frame->isLeftSide()) {
        frame->record.frame_id = ++viewer.last_frame_id;
    }
    viewer.noteBegun(frame, now);
    viewer.waiting = frame;
    return true;
}

Result<FrameWork> RenderLoop::beginWork(Viewer& viewer, const BegunFrame& frame) {
    if (viewer.source_scene != frame.state.scene) {
        viewer.source.reset();
        viewer.right_source.reset();
        viewer.source_scene = frame.state.scene;
        viewer.affordable = {};
    }
    if (!frame.state.comparison) {
        viewer.endComparison();
    }
    auto& source = viewer.sourceOf(frame);
    if (!source) {
        auto made = sourceOf(frame.state).makeView();
        if (!made) {
            return made.error();
        }
        source = std::move(*made);
    }
    const session::Delivered& with = frame.record.delivered;
    settings::ViewSettings settings =
        frame.left ? session::rightOf(frame.state).settings : frame.state.settings;
    settings.geometry_error_px =
        std::max(settings.geometry_error_px, static_cast<float>(with.geometry_error_px));
    settings = session::scaled(settings, with.scale);
    // A refined still leaves the encoder of video as it is.
    FrameTerms terms;
    terms.limit_share = viewer.affordable.limitShare();
    settings::Size encoded = settings.size;
    if (frame.state.comparison) {
        terms.limit_share /= 2; // of one picture's time
        encoded.height_px *= 2;
    }
    terms.encoding = {std::max(encode::memoryBytes(with.encoding, encoded),
                               encode::memoryBytes(frame.state.encoding, encoded)),
                      settings::rowOf(with.encoding.codec).outputs};
    if (frame.sample_count == 1 && !frame.state.comparison) {
        terms.encoding.becomes = with.encoding;
    }
    if (sendsDepth(frame)) {
        terms.encoding.outputs.add(Output::kDepthMesh);
    }
    settings.camera = frame.record.camera;
    if (frame.sample_count > 1) {
        settings.camera = settings::sampled(settings.camera, settings.size, frame.sample);
        settings.antialiasing = settings::Antialiasing::kNone; // the mean is smoother
        terms.encoding.bytes += render::SampleMean::memoryBytes(settings.size);
    }
    const FrameTime time{frame.record.time_s,
                         frame.state.playback.at(session::SessionState::secondsOf(frame.started))};
    return source->begin(settings, time, terms);
}

void RenderLoop::noteEstimate(Viewer& viewer, BegunFrame& frame, const FrameWork& work) {
    frame.estimate = work.estimate;
    frame.limit_share = work.limit_share;
    if (frame.isLeftSide()) {
        return; // the picture is both
    }
    const double scale = frame.record.delivered.scale;
    if (scale < 1 && scale == viewer.affordable.scale()) {
        const BegunFrame* left = frame.left.get();
        const Seconds estimate = work.estimate + (left != nullptr ? left->estimate : Seconds(0));
        const double share = std::max(work.limit_share, left != nullptr ? left->limit_share : 0);
        // What was asked for takes about that much more.
        frame.record.full_size_us = Microseconds(estimate).count() / (scale * scale);
        viewer.affordable.onEstimate(share, scale);
    }
}

void RenderLoop::submitPiece(Viewer& viewer) {
    BegunFrame& frame = *viewer.waiting;
    if (const auto submitted = viewer.sourceOf(frame)->submitPiece(); !submitted) {
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
    viewer.sourceOf(frame)->abandon();
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
    viewer.dropMean();
    if (viewer.left.get() == &frame) {
        viewer.left.reset();
    }
    --viewer.started;
    viewer.submitted.reset();
}

void RenderLoop::refuse(SessionId id, Viewer& viewer, const Error& error) {
    viewer.noteCompiling(false, Clock::now());
    const settings::Size& size = viewer.state.settings.size;
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
    lookAt(frame.id, viewer);
    auto collected = viewer.sourceOf(frame)->collect();
    if (!collected && collected.error().code != ErrorCode::kCapacity) {
        throw StartupError(collected.error());
    }
    const Seconds cost = spentSince(piece.submitted);
    options_.on_piece(cost);
    warnOfLongStep("piece", cost, frame.piece_estimate, frame.id, frame.state);
    scheduler_.onFinished(frame.id, chargeFor(viewer, frame, cost) - piece.charged, accounted_);
    frame.cost += cost;
    frame.held += accounted_ - std::max(piece.submitted, std::exchange(collected_, accounted_));
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

// What a frame keeps others from. Where the device is not the host, the host's part of one goes on
// beside the device's part of another. And the host sees late that the device is done: timestamps
// tell when.
Seconds RenderLoop::needOf(const BegunFrame& frame, const FrameStats& stats) const {
    if (source_->isHost()) {
        return frame.cost;
    }
    const Seconds device =
        stats.gpu_us ? std::min(frame.held, Seconds(Microseconds(*stats.gpu_us))) : frame.held;
    return std::max(frame.host, device);
}

void RenderLoop::finishFrame(Viewer& viewer, BegunFrame& frame, SourceFrame drawn) {
    const TimePoint now = Clock::now();
    frame.need = needOf(frame, drawn.stats);
    typical_cost_.add(frame.cost);
    viewer.frame_cost.add(frame.cost);
    viewer.piece_cost = frame.longest_piece;
    viewer.gave_up = false;
    if (frame.isLeftSide()) {
        frame.drawn = std::move(drawn);
        frame.record.render_us = Microseconds(now - frame.began).count();
        ++options_.fates->rendered;
        ++options_.fates->samples;
        --viewer.started; // the right side uses the credit
        return;
    }
    if (frame.left && !takeLeft(viewer, frame)) {
        return;
    }
    const Seconds need = frame.need;
    {
        const std::lock_guard lock(admission_mutex_);
        admission_.onFrame(frame.id, need, now, drawn.stats.surfaces_reused);
        admission_.setNewcomersCost(newcomersCost());
    }
    viewer.drawn = frame.state;
    viewer.drawn_scale = frame.record.delivered.scale;
    ++options_.fates->rendered;
    const session::Delivered& with = frame.record.delivered;
    if (frame.estimate > Seconds(0) && frame.record.full_size_us > 0 &&
        viewer.affordable.onTook(frame.limit_share * (need / frame.estimate), with.scale)) {
        viewer.changed = true;
    }
    if (with.refinement == session::Refinement::kInteractive) {
        keepRate(viewer, frame, now);
    }
    if (viewer.leaving) {
        ++options_.fates->viewer_gone;
        return;
    }
    if (frame.sample_count > 1 && !viewer.addSample(frame, drawn.pixels)) {
        ++options_.fates->samples;
        --viewer.started; // no credit is used
        return;
    }
    session::FrameRecord& record = frame.record;
    const PixelView& pixels = drawn.pixels.view();
    record.width_px = pixels.width_px;
    record.height_px = pixels.height_px;
    record.render_us = Microseconds(now - frame.started).count();
    std::shared_ptr<ComparedSides> sides;
    if (frame.left) {
        sides = sidesOf(frame, drawn.stats, now);
    } else {
        record.stats = std::move(drawn.stats);
    }
    viewer.pipeline->push({std::move(drawn.pixels), frame.state.key_requests, frame.state.version,
                           std::move(record), std::max(need, options_.min_frame_interval), now,
                           std::move(sides)});
}

void RenderLoop::keepRate(Viewer& viewer, const BegunFrame& frame, TimePoint now) {
    const double target_hz = viewer.state.delivery.target_fps;
    demand_.onFrame(frame.id, frame.need, target_hz, now);
    if (target_hz > 0) {
        // As if it had the device to itself, at this much a frame.
        const Seconds shared(demand_.total(now) / target_hz);
        const session::Delivered& with = frame.record.delivered;
        viewer.rate_keeper.onFrame(std::max(frame.need, shared),
                                   {with.scale, with.geometry_error_px}, now);
    }
}

// Adds what the left side took. False: it is lost, and both are drawn again.
bool RenderLoop::takeLeft(Viewer& viewer, BegunFrame& right) {
    const BegunFrame& left = *right.left;
    if (!left.drawn) {
        ++options_.fates->rendered;
        ++options_.fates->samples;
        --viewer.started;
        viewer.submitted.reset();
        viewer.changed = true;
        return false;
    }
    right.need += left.need;
    right.estimate += left.estimate;
    right.limit_share = std::max(right.limit_share, left.limit_share);
    return true;
}

// Both sides of a frame whose right one has been drawn; the record tells of both.
std::shared_ptr<ComparedSides>
RenderLoop::sidesOf(BegunFrame& right, FrameStats& right_stats, TimePoint now) {
    BegunFrame& left = *right.left;
    const session::Comparison& comparison = *right.state.comparison;
    session::ComparedRecord compared;
    compared.promised = session::promisesEqualBits(right.state);
    compared.left_us = left.record.render_us;
    compared.right_us = Microseconds(now - right.began).count();
    compared.right_stats = std::move(right_stats);
    right.record.stats = std::move(left.drawn->stats);
    right.record.compared = std::move(compared);
    const bool rests = right.record.delivered.refinement >= session::Refinement::kHigh;
    return std::make_shared<ComparedSides>(
        ComparedSides{.left = std::move(left.drawn->pixels),
                      .show = comparison.show,
                      .divided = comparison.divided,
                      .split = right.state.compare_split,
                      .left_encoding = right.state.encoding,
                      .right_encoding = session::rightOf(right.state).encoding,
                      .flip_wanted = rests || comparison.divided});
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
        keepForGood(std::move(viewer->right_source));
        viewer->under_way = 0;
    }
    keepForGood(std::move(source_));
    if (options_.scenes) {
        options_.scenes->lose();
    }
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

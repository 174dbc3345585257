#include "still/still_desk.h"

#include "core/text.h"
#include "session/compared_report.h"
#include "settings/value_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace froxel::still {

using session::RejectCode;
using session::Rejection;

namespace {

// A scene for which the device had no room is asked for once more after it: a worker of the desk's
// own may have held another, which leaves with it.
constexpr Seconds kSceneAgain{0.5};
// A scene that is still on its way after so long no longer keeps the next one from being asked for.
constexpr Seconds kSlowScene{5};
constexpr size_t kSlowScenesMost = 2;
// What is said to fit is this much smaller than computed, since not all of a frame's cost goes by
// its area.
constexpr double kCaution = 1.2;

// Of a picture and of radiance, as it is and losslessly.
uint64_t answerBytes(settings::Codec codec, const settings::Size& size) {
    uint64_t pixel_bytes = 0;
    for (size_t i = 0; i < kOutputCount; ++i) {
        const bool has = settings::rowOf(codec).outputs.has(static_cast<Output>(i));
        pixel_bytes += has ? kOutputRows[i].file_floats * sizeof(float) : 0;
    }
    pixel_bytes = pixel_bytes > 0 ? pixel_bytes : 3;
    return pixel_bytes * size.width_px * size.height_px;
}

StillRefusal later(RejectCode code, std::string message, std::chrono::seconds after) {
    return {{code, 0, "", std::move(message)}, {}, after};
}

// Of a view that no state of the scene's is.
StillRefusal refusalOf(const Rejection& why, const Entries& view) {
    StillRefusal refusal{why};
    const auto entry = std::ranges::find(view, "size", &Entry::name);
    const auto size = entry != view.end() ? settings::parseSize(entry->text)
                                          : Result<settings::Size>(settings::Size());
    if (why.too_large_by > 0 && size) {
        refusal.fits = smaller(*size, why.too_large_by);
    }
    return refusal;
}

RejectCode codeOf(const Error& error) {
    switch (error.code) {
    case ErrorCode::kUnsupported:
        return RejectCode::kUnsupported;
    case ErrorCode::kScene:
        return RejectCode::kMalformed;
    default:
        return RejectCode::kCapacity;
    }
}

StillRefusal refusalOf(const Error& error, const settings::Size& size) {
    const bool size_matters = error.too_large_by > 0;
    StillRefusal refusal{{codeOf(error), 0, size_matters ? "size" : "", error.message}};
    if (size_matters) {
        refusal.fits = smaller(size, error.too_large_by * kCaution);
    }
    return refusal;
}

} // namespace

// All but `desk` is the desk's, under its lock.
class StillDesk::StillWorker final : public session::FrameSink {
  public:
    explicit StillWorker(std::weak_ptr<StillDesk> its_desk) : desk(std::move(its_desk)) {}

    void deliver(session::ReadyFrame frame) override {
        if (const auto owner = desk.lock()) {
            owner->onDrawn(*this, std::move(frame));
        }
    }
    void refuse(Error error,
                session::SessionState /*refused*/,
                std::optional<session::SessionState> /*drawn*/) override {
        if (const auto owner = desk.lock()) {
            owner->onRefused(*this, error);
        }
    }
    void notEncoded(Error error) override {
        if (const auto owner = desk.lock()) {
            owner->onRefused(*this, error);
        }
    }
    void deviceLost(Error error) override {
        if (const auto owner = desk.lock()) {
            owner->onLost(error);
        }
    }

    const std::weak_ptr<StillDesk> desk;
    session::StreamPort* port = nullptr;   // null: not joined
    session::SessionId id = 0;             // there
    std::optional<Jobs::iterator> drawing; // none: it rests, since
    TimePoint rests_since{};
    session::SharedContext scene; // of its last picture
    settings::Size size;
    uint64_t seq = 0; // of the picture asked for last
    uint64_t delivered = 0;
};

StillDesk::StillDesk(const StillLimits& limits)
    : limits_(limits), allowances_(limits.at_once, limits.per_minute / 60),
      kept_(limits.kept_bytes), thumbnails_(limits.kept_thumbnail_bytes) {}

template <class Step>
void StillDesk::locked(const Step& step) {
    Calls calls;
    {
        const std::lock_guard lock(mutex_);
        step(calls);
    }
    for (const auto& call : calls) {
        call();
    }
}

StillStore& StillDesk::storeFor(const StillRequest& request) {
    return request.thumbnail ? thumbnails_ : kept_;
}

StillDesk::Ticket StillDesk::ask(const StillSource& source,
                                 StillRequest request,
                                 const std::optional<session::Account>& account,
                                 Answer answer,
                                 TimePoint now) {
    Ticket ticket = 0;
    locked([&](Calls& calls) {
        ticket = ++last_ticket_;
        Waiter waiter{ticket, account, std::move(answer)};
        if (const auto bytes = storeFor(request).find(request.tag)) {
            if (auto refusal = whyNotHeld(account, bytes->size(), now)) {
                putOff(waiter, std::move(*refusal), calls);
                return;
            }
            ++counts_.kept_total;
            calls.emplace_back(
                [answer = std::move(waiter.answer), held = unsent_->hold(bytes, account)] {
                    answer(StillPicture{held});
                });
            return;
        }
        add(source, std::move(request), std::move(waiter), now, calls);
        wantScenes(now, calls);
        drawNext(now, calls);
    });
    return ticket;
}

void StillDesk::add(
    const StillSource& source, StillRequest request, Waiter waiter, TimePoint now, Calls& calls) {
    const auto same =
        std::ranges::find_if(jobs_, [&](const Job& job) { return job.request.tag == request.tag; });
    auto refusal = whyNot(waiter.account, same == jobs_.end(), now);
    if (!refusal && same != jobs_.end() && same->bytes > 0) {
        refusal = whyNotHeld(waiter.account, same->bytes, now);
    }
    if (refusal) {
        putOff(waiter, std::move(*refusal), calls);
        return;
    }
    if (same != jobs_.end()) {
        same->waiters.push_back(std::move(waiter));
        return;
    }
    Job job;
    job.request = std::move(request);
    job.source = source;
    job.due = now + std::chrono::duration_cast<Clock::duration>(limits_.patience);
    job.waiters.push_back(std::move(waiter));
    jobs_.push_back(std::move(job));
    const auto here = std::prev(jobs_.end());
    alarm_(here->due);
    if (here->request.scene.empty() || here->request.scene == source.first->scene_id) {
        onSceneHere(here, source.first, now, calls);
    }
}

StillDesk::Waiting StillDesk::waiting(const std::optional<session::Account>& account) const {
    Waiting sum;
    for (const Job& job : jobs_) {
        for (const Waiter& waiter : job.waiters) {
            ++sum.all;
            sum.all_bytes += job.bytes;
            if (account && waiter.account == account) {
                ++sum.own;
                sum.own_bytes += job.bytes;
            }
        }
    }
    return sum;
}

std::optional<StillRefusal>
StillDesk::whyNot(const std::optional<session::Account>& account, bool is_new, TimePoint now) {
    constexpr std::chrono::seconds kSoon{1};
    const Waiting now_waiting = waiting(account);
    if (now_waiting.all >= limits_.waiting) {
        return later(RejectCode::kCapacity,
                     numberText(now_waiting.all) + " stills are waiting, which is the maximum",
                     kSoon);
    }
    if (now_waiting.own >= limits_.per_account) {
        return later(RejectCode::kRateLimit,
                     numberText(now_waiting.own) +
                         " stills of this address or token are waiting, which is the maximum",
                     kSoon);
    }
    if (!account || !is_new || limits_.per_minute <= 0) {
        return {};
    }
    Allowance& allowance = allowances_.of(*account, now);
    if (allowance.take(now)) {
        return {};
    }
    const auto wait = std::chrono::ceil<std::chrono::seconds>(allowance.nextAt(now) - now);
    return later(RejectCode::kRateLimit,
                 "more than " + numberText(limits_.per_minute) +
                     " stills a minute for this address or token",
                 std::max(wait, kSoon));
}

std::optional<StillRefusal> StillDesk::whyNotHeld(const std::optional<session::Account>& account,
                                                  uint64_t bytes,
                                                  TimePoint now) {
    constexpr std::chrono::seconds kSoon{5};
    const Waiting now_waiting = waiting(account);
    const uint64_t all = unsent_->all() + now_waiting.all_bytes;
    const uint64_t own = (account ? unsent_->of(*account) : 0) + now_waiting.own_bytes;
    const auto text = [](uint64_t on_their_way, const char* where) {
        return "answers of " + numberText(on_their_way >> 20U) + " MiB are being drawn or sent" +
               where + ", close to the maximum";
    };
    if (own > 0 && own + bytes > limits_.account_bytes) {
        return later(RejectCode::kRateLimit, text(own, " to this address or token"), kSoon);
    }
    const uint64_t others = now_waiting.all_bytes + bytes;
    if (all > 0 && all + bytes > limits_.all_bytes &&
        (others > limits_.all_bytes ||
         !unsent_->shrinkTo(limits_.all_bytes - others, own + bytes, now))) {
        return later(RejectCode::kCapacity, text(all, ""), kSoon);
    }
    return {};
}

void StillDesk::putOff(Waiter& waiter, StillRefusal refusal, Calls& calls) {
    ++counts_.put_off_total;
    calls.emplace_back(
        [answer = std::move(waiter.answer), refusal = std::move(refusal)] { answer(refusal); });
}

// Those that are there at once; of the others one at a time.
void StillDesk::wantScenes(TimePoint now, Calls& calls) {
    std::map<std::string, TimePoint> coming; // by id: asked for since
    for (const Job& job : jobs_) {
        if (job.stage == Stage::kScene && job.scene_asked) {
            coming.emplace(job.request.scene, *job.scene_asked);
        }
    }
    const auto isSlow = [&](const auto& one) { return now - one.second >= kSlowScene; };
    bool one_comes = coming.size() >= kSlowScenesMost || !std::ranges::all_of(coming, isSlow);
    for (auto job = jobs_.begin(); job != jobs_.end();) {
        const auto here = job++;
        if (here->stage != Stage::kScene || here->scene_asked ||
            (here->scene_at && now < *here->scene_at)) {
            continue;
        }
        session::ScenePort& scenes = *here->source.scenes;
        const std::string& id = here->request.scene;
        if (const auto other = coming.find(id); other != coming.end()) {
            here->scene_asked = other->second;
            continue;
        }
        const auto standing = scenes.reportOf(id).standing;
        const bool takes_time = standing == session::SceneStanding::kOffered ||
                                standing == session::SceneStanding::kLoading;
        if (one_comes && takes_time) {
            continue;
        }
        auto scene = scenes.want(id, shared_from_this());
        if (!scene) {
            StillRefusal refusal{session::outOfRange("scene", scene.error().message)};
            finish(here, refusal, calls);
        } else if (*scene) {
            onSceneHere(here, *scene, now, calls);
        } else {
            here->scene_asked = now;
            coming.emplace(id, now);
            one_comes = true;
            alarm_(now + std::chrono::ceil<Clock::duration>(kSlowScene));
        }
    }
}

void StillDesk::onScene(const std::string& id, Result<session::SharedContext> scene) {
    locked([&](Calls& calls) {
        const TimePoint now = Clock::now();
        for (auto job = jobs_.begin(); job != jobs_.end();) {
            const auto here = job++;
            if (here->stage != Stage::kScene || !here->scene_asked || here->request.scene != id) {
                continue;
            }
            here->scene_asked.reset();
            if (scene) {
                onSceneHere(here, *scene, now, calls);
            } else if (scene.error().code == ErrorCode::kCapacity && !here->scene_again) {
                here->scene_again = true;
                here->scene_at = now + std::chrono::duration_cast<Clock::duration>(kSceneAgain);
                alarm_(*here->scene_at);
            } else {
                StillRefusal refusal = refusalOf(scene.error(), {});
                refusal.why.field = "scene";
                finish(here, refusal, calls);
            }
        }
        drawNext(now, calls);
        wantScenes(now, calls);
    });
}

void StillDesk::onSceneHere(Jobs::iterator job,
                            const session::SharedContext& scene,
                            TimePoint now,
                            Calls& calls) {
    auto state = viewOf(scene, job->request.view, now);
    if (!state) {
        finish(job, refusalOf(state.error(), job->request.view), calls);
        return;
    }
    const uint64_t bytes = answerBytes(job->request.codec, state->settings.size);
    std::erase_if(job->waiters, [&](Waiter& waiter) {
        auto refusal = whyNotHeld(waiter.account, bytes, now);
        if (refusal) {
            putOff(waiter, std::move(*refusal), calls);
        }
        return refusal.has_value();
    });
    if (job->waiters.empty()) {
        jobs_.erase(job);
        return;
    }
    job->bytes = bytes;
    job->state = std::move(*state);
    job->state->encoding.codec = job->request.codec;
    job->stage = Stage::kQueued;
}

void StillDesk::drawNext(TimePoint now, Calls& calls) {
    for (auto job = jobs_.begin(); job != jobs_.end();) {
        const auto here = job++;
        if (here->stage != Stage::kQueued) {
            continue;
        }
        const auto worker = freeWorkerFor(*here);
        if (!worker) {
            return;
        }
        draw(here, worker, now, calls);
    }
}

// The one whose view has the right targets already; else a new one; else what rests longest.
std::shared_ptr<StillDesk::StillWorker> StillDesk::freeWorkerFor(const Job& job) {
    std::shared_ptr<StillWorker> best;
    for (const auto& worker : workers_) {
        if (worker->drawing) {
            continue;
        }
        if (worker->scene == job.state->scene && worker->size == job.state->settings.size) {
            return worker;
        }
        if (!best || worker->rests_since < best->rests_since) {
            best = worker;
        }
    }
    if (workers_.size() < limits_.workers) {
        workers_.push_back(std::make_shared<StillWorker>(weak_from_this()));
        return workers_.back();
    }
    return best;
}

void StillDesk::draw(Jobs::iterator job,
                     const std::shared_ptr<StillWorker>& its_worker,
                     TimePoint now,
                     Calls& calls) {
    StillWorker& worker = *its_worker;
    job->stage = Stage::kDrawing;
    job->state->applied.seq = ++worker.seq;
    job->state->version = worker.seq; // of a view that begins at 0
    worker.scene = job->state->scene;
    worker.size = job->state->settings.size;
    if (worker.port == nullptr) {
        const auto id = job->source.port->joinBeside(its_worker, *job->state);
        if (!id) {
            finish(job, later(RejectCode::kCapacity, id.error().message, std::chrono::seconds(5)),
                   calls);
            std::erase(workers_, its_worker);
            return;
        }
        worker.port = job->source.port;
        worker.id = *id;
    } else {
        worker.port->update(worker.id, *job->state, now);
    }
    worker.drawing = job;
    worker.port->grant(worker.id, worker.delivered + 1);
}

void StillDesk::onDrawn(StillWorker& worker, session::ReadyFrame frame) {
    locked([&](Calls& calls) {
        ++worker.delivered;
        if (!worker.drawing) {
            return;
        }
        if (frame.record.applied.seq != worker.seq) {
            worker.port->grant(worker.id, worker.delivered + 1);
            return;
        }
        const auto job = *std::exchange(worker.drawing, std::nullopt);
        ++counts_.drawn_total;
        const auto& record = frame.record;
        if (job->request.kept && !record.compared) {
            storeFor(job->request).keep(job->request.tag, frame.bytes);
        }
        const auto& scene = job->state->scene ? job->state->scene : job->source.first;
        StillPicture picture{frame.bytes, scene, job->state->encoding};
        if (record.compared) {
            const uint64_t pixels = uint64_t{record.width_px} * record.height_px;
            picture.compared = session::comparedReport(*record.compared, pixels).dump();
        }
        finish(job, picture, calls);
        goOn(worker, Clock::now(), calls);
    });
}

void StillDesk::onRefused(StillWorker& worker, const Error& error) {
    locked([&](Calls& calls) {
        if (!worker.drawing) {
            return;
        }
        const auto job = *std::exchange(worker.drawing, std::nullopt);
        finish(job, refusalOf(error, job->state->settings.size), calls);
        goOn(worker, Clock::now(), calls);
    });
}

void StillDesk::goOn(StillWorker& worker, TimePoint now, Calls& calls) {
    drawNext(now, calls);
    rest(worker, now);
}

void StillDesk::onLost(const Error& error) {
    locked([&](Calls& calls) {
        while (!jobs_.empty()) {
            finish(jobs_.begin(),
                   later(RejectCode::kDevice, error.message, std::chrono::seconds(30)), calls);
        }
        workers_.clear();
    });
}

void StillDesk::finish(Jobs::iterator job, const StillOutcome& outcome, Calls& calls) {
    if (const auto* refusal = std::get_if<StillRefusal>(&outcome)) {
        ++(refusal->retry_after ? counts_.put_off_total : counts_.refused_total);
    }
    for (Waiter& waiter : job->waiters) {
        StillOutcome given = outcome;
        if (auto* picture = std::get_if<StillPicture>(&given)) {
            picture->bytes = unsent_->hold(picture->bytes, waiter.account);
        }
        calls.emplace_back(
            [answer = std::move(waiter.answer), given = std::move(given)] { answer(given); });
    }
    jobs_.erase(job);
}

void StillDesk::rest(StillWorker& worker, TimePoint now) {
    if (worker.drawing) {
        return;
    }
    worker.rests_since = now;
    if (worker.scene && worker.scene->scene_number != 0) {
        leave(worker);
    } else {
        alarm_(now + std::chrono::duration_cast<Clock::duration>(limits_.linger));
    }
}

void StillDesk::leave(StillWorker& worker) {
    if (worker.port != nullptr) {
        worker.port->leave(worker.id);
    }
    std::erase_if(workers_, [&](const auto& other) { return other.get() == &worker; });
}

StillOutcome StillDesk::hold(const SharedBytes& bytes,
                             const std::optional<session::Account>& account,
                             TimePoint now) {
    const std::lock_guard lock(mutex_);
    if (auto refusal = whyNotHeld(account, bytes->size(), now)) {
        ++counts_.put_off_total;
        return std::move(*refusal);
    }
    return StillPicture{unsent_->hold(bytes, account)};
}

void StillDesk::cancel(Ticket ticket) {
    locked([&](Calls& calls) {
        for (auto job = jobs_.begin(); job != jobs_.end(); ++job) {
            if (std::erase_if(job->waiters,
                              [&](const Waiter& waiter) { return waiter.ticket == ticket; }) == 0) {
                continue;
            }
            if (!job->waiters.empty() || job->stage == Stage::kDrawing) {
                return; // what is being drawn is kept
            }
            const Job gone = std::move(*job);
            jobs_.erase(job);
            dismissScene(gone);
            wantScenes(Clock::now(), calls);
            return;
        }
    });
}

void StillDesk::dismissScene(const Job& gone) {
    const bool others = std::ranges::any_of(jobs_, [&](const Job& other) {
        return other.scene_asked && other.request.scene == gone.request.scene;
    });
    if (gone.scene_asked && !others) {
        gone.source.scenes->dismiss(gone.request.scene, weak_from_this());
    }
}

void StillDesk::expire(TimePoint now) {
    locked([&](Calls& calls) {
        std::vector<std::shared_ptr<StillWorker>> given_up;
        for (auto job = jobs_.begin(); job != jobs_.end();) {
            const auto here = job++;
            if (now < here->due) {
                continue;
            }
            const bool scene = here->stage == Stage::kScene;
            for (const auto& worker : workers_) {
                if (worker->drawing == here) {
                    worker->drawing.reset(); // its picture comes to nobody
                    ++worker->seq;
                    given_up.push_back(worker);
                }
            }
            Job gone;
            gone.request.scene = here->request.scene;
            gone.source = here->source;
            gone.scene_asked = here->scene_asked;
            finish(here,
                   later(RejectCode::kCapacity,
                         scene ? "the scene was not ready in time"
                               : "the device has no time for this still",
                         std::chrono::seconds(10)),
                   calls);
            dismissScene(gone);
        }
        for (const auto& worker : given_up) {
            goOn(*worker, now, calls);
        }
        for (size_t i = workers_.size(); i-- > 0;) {
            StillWorker& worker = *workers_[i];
            if (!worker.drawing && now - worker.rests_since >= limits_.linger) {
                leave(worker);
            }
        }
        wantScenes(now, calls);
        drawNext(now, calls);
        setNextAlarm(now);
    });
}

// The alarm keeps the earliest alone.
void StillDesk::setNextAlarm(TimePoint now) const {
    std::optional<TimePoint> next;
    const auto isNext = [&](TimePoint due) {
        if (due > now) {
            next = next ? std::min(*next, due) : due;
        }
    };
    const auto after = [](TimePoint at, Seconds wait) {
        return at + std::chrono::ceil<Clock::duration>(wait);
    };
    for (const Job& job : jobs_) {
        isNext(job.due);
        if (job.scene_at) {
            isNext(*job.scene_at);
        }
        if (job.scene_asked) {
            isNext(after(*job.scene_asked, kSlowScene));
        }
    }
    for (const auto& worker : workers_) {
        if (!worker->drawing) {
            isNext(after(worker->rests_since, limits_.linger));
        }
    }
    if (next) {
        alarm_(*next);
    }
}

void StillDesk::close() {
    const std::lock_guard lock(mutex_);
    alarm_ = [](TimePoint) {};
}

StillCounts StillDesk::counts() const {
    const std::lock_guard lock(mutex_);
    return counts_;
}

} // namespace froxel::still

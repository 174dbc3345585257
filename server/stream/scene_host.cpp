#include "stream/scene_host.h"

#include "core/keep_for_good.h"
#include "core/text.h"
#include "core/thread_name.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <unistd.h>
#include <utility>

namespace froxel::stream {

using session::SceneWaiter;
using session::SharedContext;

namespace {

// Of the thread that reads, and of those that it starts: a tenth of the weight of others'.
constexpr int kNiceness = 10;

// Of threads that read, and how many of them may read for those who are patient: there is always
// one for a viewer.
constexpr size_t kReaders = 4;
constexpr size_t kPatientReaders = 2;
// How often those who wait for their turn look again.
constexpr std::chrono::milliseconds kLook{100};

// The device is asked so often whether it is done with a slice.
constexpr std::chrono::milliseconds kPoll{1};

// More than a catalogue has (catalogue::Catalogue::kMostScenes).
constexpr size_t kContentsMost = 16'384;

// What reading takes of the whole, for progress.
constexpr double kReadPart = 0.5;

uint64_t mib(uint64_t bytes) {
    return (bytes >> 20U) + 1;
}

} // namespace

SceneHost::SceneHost(SceneHostOptions options) : options_(std::move(options)) {
    for (size_t i = 0; i < kReaders; ++i) {
        readers_.emplace_back([this](const std::stop_token& stop) {
            nameThread("scenes");
            (void)nice(kNiceness); // of this thread alone, on Linux
            run(stop);
        });
    }
}

SceneHost::~SceneHost() {
    end();
}

Result<SharedContext> SceneHost::want(const std::string& id,
                                      const std::shared_ptr<SceneWaiter>& waiter) {
    const std::lock_guard lock(mutex_);
    const auto version = options_.offers(id);
    if (isFirst(id, version)) {
        return first_;
    }
    if (!version) {
        return Error{ErrorCode::kInvalidArgument,
                     "is \"" + printable(id) + "\", which is not a scene of this server"};
    }
    for (auto& [number, resident] : residents_) {
        if (resident.id == id && resident.version == *version) {
            resident.asked_at = Clock::now();
            return resident.context;
        }
    }
    if (device_ == nullptr) {
        return Error{ErrorCode::kCapacity, "the server is shutting down and loads no more scenes"};
    }
    auto [coming, is_new] = coming_.try_emplace(id);
    if (is_new) {
        coming->second.version = *version;
        coming->second.begun_at = Clock::now();
        queue_.push_back(id);
        queued_.notify_one();
    }
    coming->second.waiters.push_back(waiter);
    coming->second.patient = coming->second.patient && waiter->isPatient();
    return SharedContext();
}

session::SceneReport SceneHost::reportOf(const std::string& id) const {
    using session::SceneStanding;
    const std::lock_guard lock(mutex_);
    const auto version = options_.offers(id);
    if (isFirst(id, version)) {
        return {SceneStanding::kReady, {}, session::contentsOf(first_->scene)};
    }
    if (!version) {
        return {};
    }
    session::SceneReport report{SceneStanding::kOffered, {}, {}};
    if (const auto known = contents_.find(id);
        known != contents_.end() && known->second.version == *version) {
        report.contents = known->second.of;
    }
    if (std::ranges::any_of(residents_, [&](const auto& entry) {
            return entry.second.id == id && entry.second.version == *version;
        })) {
        report.standing = SceneStanding::kReady;
    } else if (const auto coming = coming_.find(id); coming != coming_.end()) {
        report.standing = SceneStanding::kLoading;
        report.progress = coming->second.progress;
    }
    return report;
}

void SceneHost::dismiss(const std::string& id, const std::weak_ptr<SceneWaiter>& waiter) {
    const std::lock_guard lock(mutex_);
    const auto coming = coming_.find(id);
    if (coming == coming_.end()) {
        return;
    }
    std::erase_if(coming->second.waiters, [&](const auto& other) {
        return !other.owner_before(waiter) && !waiter.owner_before(other);
    });
    wake_(); // where nobody waits for it any more, what was moved of it goes
}

session::SceneCounts SceneHost::counts() const {
    const std::lock_guard lock(mutex_);
    session::SceneCounts counts = counts_;
    counts.resident = static_cast<uint32_t>(residents_.size()) + (first_ ? 1U : 0U);
    counts.loading = static_cast<uint32_t>(coming_.size());
    counts.bytes = bytesTaken();
    return counts;
}

void SceneHost::begin(FrameSource& device,
                      SharedContext first,
                      uint64_t first_version,
                      uint64_t scene_bytes,
                      std::function<void()> wake) {
    const std::lock_guard lock(mutex_);
    device_ = &device;
    first_ = std::move(first);
    first_version_ = first_version;
    scene_bytes_ = scene_bytes;
    wake_ = std::move(wake);
}

bool SceneHost::isFirst(const std::string& id, std::optional<uint64_t> version) const {
    return first_ && id == first_->scene_id && (!version || *version == first_version_);
}

SceneSource& SceneHost::sourceOf(const session::SessionContext* scene) {
    const std::lock_guard lock(mutex_);
    return scene == nullptr || scene->scene_number == 0
               ? *device_
               : *residents_.at(scene->scene_number).source;
}

void SceneHost::end() {
    {
        const std::lock_guard lock(mutex_);
        device_ = nullptr;
        queue_.clear();
    }
    for (std::jthread& reader : readers_) {
        reader.request_stop();
    }
    readers_.clear(); // each is waited for
    const std::lock_guard lock(mutex_);
    coming_.clear();
    residents_.clear();
    leaving_.clear();
}

void SceneHost::lose() {
    const std::lock_guard lock(mutex_);
    device_ = nullptr;
    queue_.clear();
    for (auto& [id, coming] : coming_) {
        keepForGood(std::move(coming.move));
    }
    for (auto& [number, resident] : residents_) {
        keepForGood(std::move(resident.source));
    }
    for (auto& source : leaving_) {
        keepForGood(std::move(source));
    }
    residents_.clear();
    leaving_.clear();
}

void SceneHost::run(const std::stop_token& stop) {
    for (;;) {
        std::string id;
        {
            std::unique_lock lock(mutex_);
            if (!queued_.wait(lock, stop, [this] { return !queue_.empty(); })) {
                return;
            }
            const auto next = nextToLoad(Clock::now());
            if (next == queue_.end()) {
                queued_.wait_for(lock, stop, kLook, [] { return false; });
                continue;
            }
            id = std::move(*next);
            queue_.erase(next);
            Coming& coming = coming_.at(id);
            if (!isAwaited(coming)) {
                coming_.erase(id);
                continue;
            }
            coming.stage = Stage::kReading;
            coming.read_since = Clock::now();
        }
        load(id);
        queued_.notify_all(); // it may be another's turn
    }
}

// The first that is not waited for patiently; else the first. What nobody waits for any more goes
// with these.
std::deque<std::string>::iterator SceneHost::nextToLoad(TimePoint now) {
    const auto gone = std::ranges::find_if(
        queue_, [this](const std::string& id) { return !isAwaited(coming_.at(id)); });
    if (gone != queue_.end()) {
        return gone;
    }
    size_t patient = 0;
    for (const auto& [id, coming] : coming_) {
        if (coming.stage != Stage::kReading) {
            continue;
        }
        if (now - *coming.read_since < options_.turn) {
            return queue_.end();
        }
        patient += coming.patient ? 1 : 0;
    }
    const auto next = std::ranges::find_if(
        queue_, [this](const std::string& id) { return !coming_.at(id).patient; });
    return next == queue_.end() && patient < kPatientReaders ? queue_.begin() : next;
}

void SceneHost::load(const std::string& id) {
    bool wanted = true;
    const TimePoint begun_at = Clock::now();
    bool in_time = true;
    const auto readOn = [&](const Progress& progress) {
        report(id, {progress.stage, kReadPart * progress.fraction});
        wanted = isWanted(id);
        in_time = Clock::now() - begun_at < options_.most_reading;
        return wanted && in_time;
    };
    try {
        auto read = options_.read(id, readOn);
        if (!wanted || !isWanted(id)) {
            putAside(id);
            return;
        }
        if (!in_time) {
            finish(id, Error{ErrorCode::kScene,
                             fmt::format(
                                 "reading did not finish within {:.0f} s; expected a smaller scene",
                                 options_.most_reading.count())});
            return;
        }
        auto prepared = read ? prepare(id, std::move(*read)) : Result<void>(read.error());
        if (!prepared) {
            finish(id, prepared.error());
        }
    } catch (const StartupError& error) {
        finish(id, Error{error.code(), error.what()});
    } catch (const std::exception& error) {
        finish(id,
               Error{ErrorCode::kCapacity, std::string("it could not be loaded: ") + error.what()});
    }
}

bool SceneHost::isWanted(const std::string& id) const {
    const std::lock_guard lock(mutex_);
    return isAwaited(coming_.at(id));
}

// What was not read to its end; whoever came since waits for it as if it were new.
void SceneHost::putAside(const std::string& id) {
    const std::lock_guard lock(mutex_);
    Coming& coming = coming_.at(id);
    if (!isAwaited(coming)) {
        coming_.erase(id);
        return;
    }
    coming.stage = Stage::kQueued;
    queue_.push_front(id);
}

Result<void> SceneHost::prepare(const std::string& id, ReadScene read) {
    FrameSource* device = nullptr;
    uint64_t bytes = 0;
    {
        const std::lock_guard lock(mutex_);
        if (device_ == nullptr) {
            coming_.erase(id);
            return {};
        }
        Coming& coming = coming_.at(id);
        device = device_;
        bytes = device->sceneBytes(*read.scene);
        if (auto room = makeRoom(bytes, read.context.scene.name); !room) {
            return room;
        }
        coming.bytes = bytes;
        keepContents(id, {coming.version, session::contentsOf(read.context.scene)});
        read.context.scene_id = id;
        read.context.scene_number = ++last_number_;
    }
    report(id, {"moving the scene to the device", kReadPart});
    auto move = device->moveScene(std::move(read.scene));
    if (!move) {
        return move.error();
    }
    const std::lock_guard lock(mutex_);
    Coming& coming = coming_.at(id);
    coming.move = std::move(*move);
    coming.context = std::make_shared<const session::SessionContext>(std::move(read.context));
    coming.stage = Stage::kMoving;
    wake_();
    return {};
}

// Folders change: what is not offered any more is forgotten, lest names fill memory.
void SceneHost::keepContents(const std::string& id, Contents contents) {
    if (contents_.size() >= kContentsMost) {
        std::erase_if(contents_, [&](const auto& known) { return !options_.offers(known.first); });
    }
    if (contents_.size() < kContentsMost || contents_.contains(id)) {
        contents_[id] = std::move(contents);
    }
}

uint64_t SceneHost::bytesTaken() const {
    uint64_t bytes = 0;
    for (const auto& [number, resident] : residents_) {
        bytes += resident.source->bytes();
    }
    for (const auto& [id, coming] : coming_) {
        bytes += coming.bytes;
    }
    return bytes;
}

// The table's own reference is the only one: new ones are made under the lock alone, or of others.
bool SceneHost::isHeld(const Resident& resident) {
    return resident.context.use_count() > 1;
}

Result<void> SceneHost::makeRoom(uint64_t bytes, const std::string& name) {
    uint64_t free_bytes = 0;
    for (const auto& [number, resident] : residents_) {
        free_bytes += isHeld(resident) ? 0 : resident.source->bytes();
    }
    uint64_t taken = bytesTaken();
    const uint64_t held = taken - free_bytes;
    if (bytes > scene_bytes_ || held > scene_bytes_ - bytes) {
        return Error{
            ErrorCode::kCapacity,
            fmt::format(
                "{} takes {} MiB of the device's memory; {} MiB of the {} for scenes are in use",
                printable(name), mib(bytes), held >> 20U, scene_bytes_ >> 20U)};
    }
    while (taken > scene_bytes_ - bytes) {
        auto oldest = residents_.end();
        for (auto resident = residents_.begin(); resident != residents_.end(); ++resident) {
            if (!isHeld(resident->second) &&
                (oldest == residents_.end() ||
                 resident->second.asked_at < oldest->second.asked_at)) {
                oldest = resident;
            }
        }
        taken -= oldest->second.source->bytes();
        ++counts_.evicted_total;
        oldest = leave(oldest);
    }
    wake_();
    return {};
}

SceneHost::Residents::iterator SceneHost::leave(Residents::iterator resident) {
    spdlog::info("event=scene_left scene={} bytes={}",
                 logValue(resident->second.context->scene.name), resident->second.source->bytes());
    leaving_.push_back(std::move(resident->second.source));
    return residents_.erase(resident);
}

bool SceneHost::dropWithdrawn() {
    bool held = false;
    for (auto resident = residents_.begin(); resident != residents_.end();) {
        if (options_.offers(resident->second.id)) {
            ++resident;
        } else if (isHeld(resident->second)) {
            held = true;
            ++resident;
        } else {
            resident = leave(resident);
        }
    }
    return held;
}

void SceneHost::tidy() {
    const std::lock_guard lock(mutex_);
    withdrawn_ = true;
    wake_();
}

bool SceneHost::isAwaited(const Coming& coming) const {
    return device_ != nullptr && !std::ranges::all_of(coming.waiters, [](const auto& waiter) {
               return waiter.expired();
           });
}

SceneHost::Waiters SceneHost::present(const Coming& coming) {
    Waiters waiters;
    for (const auto& waiter : coming.waiters) {
        if (auto here = waiter.lock()) {
            waiters.push_back(std::move(here));
        }
    }
    return waiters;
}

void SceneHost::report(const std::string& id, const Progress& progress) {
    Waiters waiters;
    {
        const std::lock_guard lock(mutex_);
        const auto coming = coming_.find(id);
        if (coming == coming_.end()) {
            return;
        }
        coming->second.progress = progress;
        waiters = present(coming->second);
    }
    for (const auto& waiter : waiters) {
        waiter->onSceneProgress(id, progress);
    }
}

void SceneHost::finish(const std::string& id, Result<SharedContext> outcome) {
    Waiters waiters;
    Seconds took{0};
    {
        const std::lock_guard lock(mutex_);
        const auto coming = coming_.find(id);
        if (coming == coming_.end()) {
            return;
        }
        waiters = present(coming->second);
        took = Clock::now() - coming->second.begun_at;
        coming_.erase(coming);
        if (outcome) {
            ++counts_.loaded_total;
        } else if (outcome.error().code == ErrorCode::kCapacity) {
            ++counts_.refused_total;
        } else {
            ++counts_.failed_total;
        }
    }
    if (outcome) {
        spdlog::info("event=scene_loaded scene={} triangles={} seconds={:.2f}",
                     logValue((*outcome)->scene.name), (*outcome)->scene.triangle_count,
                     took.count());
    } else {
        // Of its id a part: the whole is the key to a scene that a client brought.
        spdlog::warn("event=scene_not_loaded scene={} seconds={:.2f} reason={}",
                     logValue(id.substr(0, 8)), took.count(),
                     logValue(outcome.error().message, 400));
    }
    for (size_t i = 0; i < waiters.size(); ++i) { // nothing here holds it when the last one has it
        const bool last = i + 1 == waiters.size();
        waiters[i]->onScene(id, last ? std::move(outcome) : outcome);
    }
}

std::optional<TimePoint> SceneHost::work(TimePoint now) {
    std::unique_ptr<SceneSource> leaving; // ends outside of the lock
    std::unique_ptr<SceneMove> given_up;
    std::string id;
    SceneMove* move = nullptr;
    {
        const std::lock_guard lock(mutex_);
        withdrawn_ = withdrawn_ && dropWithdrawn();
        if (!leaving_.empty()) {
            leaving = std::move(leaving_.back());
            leaving_.pop_back();
        }
        for (auto coming = coming_.begin(); coming != coming_.end(); ++coming) {
            if (coming->second.stage != Stage::kMoving) {
                continue;
            }
            if (!isAwaited(coming->second)) {
                given_up = std::move(coming->second.move);
                coming_.erase(coming);
            } else {
                id = coming->first;
                move = coming->second.move.get();
            }
            break;
        }
        if (!leaving && !given_up && move == nullptr) {
            return withdrawn_ ? std::optional(now + kLook) : std::nullopt;
        }
    }
    if (move != nullptr) {
        advance(id, *move);
    }
    return now + kPoll;
}

// The move is the render thread's alone until it is done.
void SceneHost::advance(const std::string& id, SceneMove& move) {
    const double before = move.fraction();
    auto source = move.advance();
    if (!source) {
        if (source.error().code != ErrorCode::kCapacity) {
            throw StartupError(source.error());
        }
        std::unique_ptr<SceneMove> given_up; // ends outside of the lock
        {
            const std::lock_guard lock(mutex_);
            given_up = std::move(coming_.at(id).move);
        }
        given_up.reset();
        finish(id, source.error());
        return;
    }
    if (*source) {
        settle(id, std::move(*source));
    } else if (move.fraction() != before) {
        report(id,
               {"moving the scene to the device", kReadPart + (1 - kReadPart) * move.fraction()});
    }
}

void SceneHost::settle(const std::string& id, std::unique_ptr<SceneSource> source) {
    SharedContext context;
    {
        const std::lock_guard lock(mutex_);
        Coming& coming = coming_.at(id);
        context = std::move(coming.context);
        coming.bytes = 0;
        residents_[context->scene_number] = {id, coming.version, context, std::move(source),
                                             Clock::now()};
    }
    finish(id, std::move(context));
}

} // namespace froxel::stream

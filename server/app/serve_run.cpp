#include "app/serve_run.h"

#include "app/log_setup.h"
#include "core/keep_for_good.h"
#include "net/health.h"
#include "net/metrics.h"
#include "session/session_state.h"
#include "stream/frame_cost.h"

#include <spdlog/spdlog.h>

#include <utility>

namespace froxel::app {
namespace {

// So that a crowd that waits for the scene is let in as far as the device goes. None where the
// first picture cannot be made, which each viewer is told.
std::optional<Seconds> frameCost(std::unique_ptr<stream::FrameSource>& source,
                                 const session::SessionContext& context) {
    const auto first = session::initialState(context, Clock::now());
    const auto cost = stream::measureFrameCost(*source, first.settings);
    if (!cost) {
        if (cost.error().code == ErrorCode::kDevice) {
            keepForGood(std::move(source));
            throw StartupError(cost.error());
        }
        return {};
    }
    spdlog::info("event=frame_priced ms={:.2f}", cost->count() * 1e3);
    return *cost;
}

// After a change of the folder of scenes: a file that is copied changes more often.
constexpr Seconds kFolderRest{1};

} // namespace

// A viewer has at most one picture in the encoders, so the queue never refuses one.
ServeRun::ServeRun(ServeRunOptions options)
    : options_(std::move(options)),
      pool_(options_.encoder_count,
            options_.server.lobby.sessions_max + options_.server.stills.workers),
      scenes_(makeScenes()), server_(std::make_unique<net::Server>(options_.server)),
      loop_(pool_, loopOptions()) {
    if (options_.catalogue && !options_.catalogue->folder().empty()) {
        watch_.emplace(options_.catalogue->folder(), catalogue::Catalogue::kDeepest, kFolderRest,
                       [catalogue = options_.catalogue] { return catalogue->rescan(); });
        watch_->lookAgain(); // what has changed before it was watched
    }
}

ServeRun::~ServeRun() {
    loop_.stop();    // no picture is on its way to a connection after this
    server_.reset(); // connections take their leave of the loop
}

Result<void> ServeRun::rendersOn() const {
    return net::rendersOn(server_->service().status(), Clock::now());
}

void ServeRun::giveUp(const std::string& why) {
    if (options_.losses) {
        options_.losses->add();
    }
    server_->giveUp(why);
}

void ServeRun::rescan() {
    if (watch_) {
        watch_->lookAgain();
    }
}

std::shared_ptr<stream::SceneHost> ServeRun::makeScenes() {
    stream::SceneHostOptions scenes;
    scenes.offers =
        [catalogue = options_.catalogue, guests = options_.server.guests,
         store = options_.server.guest_store](const std::string& id) -> std::optional<uint64_t> {
        if ((store && store->isReady(id)) || guests->find(id)) {
            return 0; // it never changes
        }
        const auto offered = catalogue ? catalogue->find(id) : std::nullopt;
        return offered ? std::optional(offered->version) : std::nullopt;
    };
    scenes.read = [this](const std::string& id, const ProgressReport& report) {
        return readScene(id, report);
    };
    auto host = std::make_shared<stream::SceneHost>(std::move(scenes));
    const auto tidy = [weak = std::weak_ptr(host)] {
        if (const auto still_there = weak.lock()) {
            still_there->tidy();
        }
    };
    options_.server.guests->onTakenOff(tidy);
    if (options_.server.guest_store) {
        options_.server.guest_store->onRemoved(tidy);
    }
    return host;
}

Result<stream::ReadScene> ServeRun::readScene(const std::string& id, const ProgressReport& report) {
    auto brought = options_.server.guests->find(id);
    if (!brought && options_.server.guest_store) {
        brought = options_.server.guest_store->use(id, std::chrono::system_clock::now());
    }
    if (brought) {
        return read_guest_(brought, report);
    }
    const auto offered = options_.catalogue ? options_.catalogue->find(id) : std::nullopt;
    if (!offered) {
        return Error{ErrorCode::kScene, "the file no longer exists"};
    }
    auto read = read_other_(*offered, report);
    if (read) {
        options_.catalogue->noteRead(id, offered->version, read->scene->files);
    }
    return read;
}

stream::RenderLoopOptions ServeRun::loopOptions() {
    stream::RenderLoopOptions loop;
    loop.scenes = scenes_;
    loop.on_failure = options_.on_failure;
    loop.fates = server_->metrics().fates();
    loop.on_begun = [this](Seconds took) { server_->metrics().frameBegun(took); };
    loop.on_piece = [this](Seconds took) { server_->metrics().pieceDrawn(took); };
    server_->metrics().setSessionCapacity(options_.server.lobby.sessions_max);
    if (options_.losses) {
        server_->metrics().setDeviceLosses(options_.losses->count());
    }
    server_->metrics().watchLog(logLinesLost);
    loop.make_source = [this, heartbeat = loop.heartbeat] { return open(heartbeat); };
    return loop;
}

std::unique_ptr<stream::FrameSource>
ServeRun::open(const std::shared_ptr<const Heartbeat>& heartbeat) {
    net::Service& service = server_->service();
    const auto offered =
        options_.catalogue ? options_.catalogue->listing()->scenes().front() : catalogue::Offered();
    OpenedScene opened = options_.open([&service](const Progress& progress) {
        service.setLoading(progress);
        return true;
    });
    opened.context.scene_id = offered.id;
    auto context = std::make_shared<const session::SessionContext>(std::move(opened.context));
    read_other_ = std::move(opened.read_other);
    read_guest_ = std::move(opened.read_guest);
    server_->metrics().watchScenes([scenes = scenes_] { return scenes->counts(); });
    scenes_->begin(*opened.source, context, offered.version, opened.scene_bytes,
                   [this] { loop_.wake(); });
    if (options_.catalogue) {
        options_.catalogue->noteRead(offered.id, offered.version, std::move(opened.files));
    }
    server_->metrics().watchMemory(std::move(opened.memory));
    if (const double rate_hz = context->defaults.min_rate_hz; rate_hz > 0) {
        loop_.setMinRate(rate_hz, frameCost(opened.source, *context));
        loop_.setNewcomersFrame(session::initialState(*context, Clock::now()).settings);
    }
    server_->metrics().watchLoad([this] { return loop_.load(Clock::now()); });
    service.setServing({std::move(context), &loop_, heartbeat, opened.step_limit, scenes_.get(),
                        options_.offers_depth});
    return std::move(opened.source);
}

} // namespace froxel::app

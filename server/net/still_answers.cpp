#include "net/still_answers.h"

#include "core/text.h"
#include "net/request_form.h"
#include "net/scene_listing.h"
#include "net/still_series.h"
#include "session/state_message.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <random>
#include <utility>

namespace froxel::net {

namespace http = boost::beast::http;

namespace {

// While the first scene is loaded.
constexpr Seconds kPatience = still::StillLimits().patience;
constexpr size_t kMostEarly = still::StillLimits().waiting;
constexpr ptrdiff_t kMostEarlyOfAccount = still::StillLimits().per_account;

Response
refused(http::status status, const char* code, const std::string& field, const std::string& text) {
    return apiRefusal(status, {code, field, field.empty() ? text : field + " " + text});
}

http::status statusOf(const still::StillRefusal& refusal) {
    if (refusal.why.code == session::RejectCode::kRateLimit) {
        return http::status::too_many_requests;
    }
    if (refusal.retry_after) {
        return http::status::service_unavailable;
    }
    return refusal.why.field == "scene" && refusal.why.code == session::RejectCode::kOutOfRange
               ? http::status::not_found
               : http::status::bad_request;
}

Response unavailable(const std::string& why) {
    Response response = refused(http::status::service_unavailable, "capacity", "", why);
    response.set(http::field::retry_after, "5");
    return response;
}

// A gallery has no use for why a scene has no thumbnail: it is no error there.
Response refusedBy(const still::StillRefusal& refusal, bool thumbnail) {
    if (thumbnail && statusOf(refusal) == http::status::bad_request) {
        Response none = makeResponse(http::status::no_content, "image/jpeg", {});
        none.set(http::field::cache_control, "no-cache");
        return none;
    }
    const auto& fits = refusal.fits;
    Response response =
        apiRefusal(statusOf(refusal),
                   {session::nameOf(refusal.why.code), refusal.why.field, refusal.why.message,
                    fits ? fmt::format("{}x{}", fits->width_px, fits->height_px) : std::string()});
    if (refusal.retry_after) {
        response.set(http::field::retry_after, numberText(refusal.retry_after->count()));
    }
    return response;
}

// What counts until it is sent, and may have to go for others' (Unsent::shrinkTo).
LateAnswer onItsWay(Response response, const SharedBytes& bytes) {
    return {std::move(response), bytes, [held = std::weak_ptr(bytes)](std::function<void()> close) {
                if (const auto sent = held.lock()) {
                    still::Unsent::sending(sent, std::move(close), Clock::now());
                }
            }};
}

// One of the scene's path and "/thumb"; empty: none.
std::string_view sceneOfThumbnail(std::string_view path) {
    if (!SceneListing::has(path) || !path.ends_with(kThumbnail)) {
        return {};
    }
    path.remove_suffix(kThumbnail.size());
    return path.size() > kScenesPath.size() ? path.substr(kScenesPath.size() + 1)
                                            : std::string_view();
}

} // namespace

StillAnswers::StillAnswers(std::shared_ptr<still::StillDesk> desk,
                           std::shared_ptr<const catalogue::Catalogue> catalogue,
                           std::shared_ptr<const Service> service,
                           LongWork& long_work)
    : desk_(std::move(desk)), catalogue_(std::move(catalogue)), service_(std::move(service)),
      long_work_(long_work), run_(numberText(std::random_device()())) {}

bool StillAnswers::has(std::string_view path) {
    return path == kStillPath || !sceneOfThumbnail(path).empty();
}

// Without a catalogue nobody knows of what file a server was started.
std::string StillAnswers::sceneTag(const std::string& scene) const {
    const auto offered = !catalogue_     ? std::nullopt
                         : scene.empty() ? std::optional(catalogue_->listing()->scenes().front())
                                         : catalogue_->find(scene);
    return offered ? offered->id + " " + numberText(offered->version) : run_ + " " + scene;
}

bool StillAnswers::lasts(const Request& request, const still::StillRequest& still) const {
    const auto offered =
        still.thumbnail && catalogue_ ? catalogue_->find(still.scene) : std::nullopt;
    return offered && viewOf(request.target()).ends_with(fmt::format("?v={:x}", offered->version));
}

std::variant<WantedStill, Response> StillAnswers::read(const Asked& asked) const {
    if (const auto scene = sceneOfThumbnail(asked.path); !scene.empty()) {
        return thumbnailOf(scene, kThumbnailSize);
    }
    const auto target = targetOf(asked.request);
    if (!target) {
        return refused(http::status::bad_request, "malformed", "", "the address is malformed");
    }
    auto wanted = readStillAddress(*target, asked.guest != nullptr);
    if (auto* read = std::get_if<WantedStill>(&wanted)) {
        still::StillRequest& still = read->still;
        still.scene = asked.guest ? asked.guest->id() : still.scene;
        // Of a client's scene none stays, which its owner may remove.
        still.kept = still.scene.empty() || (catalogue_ && catalogue_->find(still.scene));
    }
    return wanted;
}

std::string
StillAnswers::tagOf(const Serving& serving, const Asked& asked, const WantedStill& wanted) const {
    const still::StillRequest& still = wanted.still;
    std::string tag = serving.context->server_version + "\n" + serving.context->device_name + "\n" +
                      (asked.guest ? still.scene : sceneTag(still.scene)) + "\n" +
                      std::string(wanted.format->name);
    for (const auto& [name, text] : still.view) {
        tag += "\n" + name + "=" + text;
    }
    for (const still::NamedView* view : wanted.views) {
        tag += "\nviews=" + std::string(view->name);
    }
    return tag;
}

HttpSite::CallOff StillAnswers::answer(const Asked& asked, const Done& done) {
    const auto nothing = [] {};
    const ServiceStatus status = service_->status();
    if (status.draining || status.lost) {
        done({unavailable(status.lost ? "the device was lost" : "the server is going down")});
        return nothing;
    }
    if (status.serving) {
        return draw(*status.serving, asked, done);
    }
    const auto early = std::make_shared<Early>();
    early->account = asked.caller.limited().value_or(session::Account()).key;
    early->due = Clock::now() + std::chrono::duration_cast<Clock::duration>(kPatience);
    early->done = done;
    early->ask = [this, asked, done] { return answer(asked, done); };
    if (auto call_off = waitForScene(early)) {
        return std::move(*call_off);
    }
    done({unavailable("the scene is loading, and too many requests wait for it")});
    return nothing;
}

std::optional<HttpSite::CallOff> StillAnswers::waitForScene(std::shared_ptr<Early> early) {
    {
        const std::lock_guard lock(mutex_);
        const auto of_account = std::ranges::count(early_, early->account,
                                                   [](const auto& one) { return one->account; });
        const bool limited = !early->account.empty();
        if (early_.size() >= kMostEarly || (limited && of_account >= kMostEarlyOfAccount)) {
            return {};
        }
        early_.push_back(early);
    }
    alarm_(early->due);
    onServiceChanged(); // the scene may have come meanwhile
    return [self = shared_from_this(), early] {
        {
            const std::lock_guard lock(self->mutex_);
            std::erase(self->early_, early);
        }
        const std::lock_guard lock(early->mutex);
        early->called_off = true;
        if (early->call_off) {
            early->call_off();
        }
    };
}

void StillAnswers::onServiceChanged() {
    const ServiceStatus status = service_->status();
    if (!status.serving && !status.draining && !status.lost) {
        return;
    }
    std::list<std::shared_ptr<Early>> early;
    {
        const std::lock_guard lock(mutex_);
        early.swap(early_);
    }
    for (const auto& one : early) {
        const std::lock_guard lock(one->mutex);
        if (!one->called_off) {
            one->call_off = one->ask();
        }
    }
}

void StillAnswers::expire(TimePoint now) {
    std::list<std::shared_ptr<Early>> over;
    std::optional<TimePoint> next;
    {
        const std::lock_guard lock(mutex_);
        while (!early_.empty() && early_.front()->due <= now) {
            over.splice(over.end(), early_, early_.begin());
        }
        if (!early_.empty()) {
            next = early_.front()->due;
        }
    }
    if (next) {
        alarm_(*next);
    }
    for (const auto& one : over) {
        one->done({unavailable("the scene is still loading")});
    }
}

void StillAnswers::close() {
    std::list<std::shared_ptr<Early>> early; // connections end with it
    const std::lock_guard lock(mutex_);
    early.swap(early_);
}

HttpSite::CallOff
StillAnswers::draw(const Serving& serving, const Asked& asked, const Done& done) const {
    const auto nothing = [] {};
    auto read_address = read(asked);
    if (auto* refusal = std::get_if<Response>(&read_address)) {
        done({std::move(*refusal)});
        return nothing;
    }
    WantedStill& wanted = std::get<WantedStill>(read_address);
    wanted.still.tag = tagOf(serving, asked, wanted);
    const std::string etag = etagOf(wanted.still.tag);
    const std::string caching = std::string(asked.shared ? "" : "private, ") +
                                (lasts(asked.request, wanted.still) ? "max-age=86400" : "no-cache");
    // The next one of a scene that comes with the request is another one.
    const auto tagged = [etag, caching, once = asked.guest != nullptr](Response response) {
        if (!once) {
            response.set(http::field::etag, etag);
            response.set(http::field::cache_control, caching);
        }
        return response;
    };
    if (!asked.guest && hasAlready(asked.request, etag)) {
        done({tagged(makeResponse(http::status::not_modified, wanted.format->content_type, {}))});
        return nothing;
    }
    return wanted.isSeries() ? drawSeries(serving, asked, std::move(wanted), tagged, done)
                             : drawOne(serving, asked, std::move(wanted), tagged, done);
}

HttpSite::CallOff StillAnswers::drawOne(const Serving& serving,
                                        const Asked& asked,
                                        WantedStill wanted,
                                        const Tagged& tagged,
                                        const Done& done) const {
    // Of what there is nothing of yet; whether there will be is found out by drawing it.
    const bool any = !asked.guest && hasAnything(asked.request);
    const bool thumbnail = wanted.still.thumbnail;
    const auto type = wanted.format->content_type;
    const auto ticket = desk_->ask(
        {serving.context, serving.port, serving.scenes}, std::move(wanted.still),
        asked.caller.limited(),
        [done, tagged, type, thumbnail, any,
         guest = asked.guest](const still::StillOutcome& outcome) {
            if (const auto* refusal = std::get_if<still::StillRefusal>(&outcome)) {
                done({refusedBy(*refusal, thumbnail)});
            } else if (any) {
                done({tagged(makeResponse(http::status::not_modified, type, {}))});
            } else {
                const auto& picture = std::get<still::StillPicture>(outcome);
                Response response = tagged(makeResponse(http::status::ok, type, {}));
                if (!picture.compared.empty()) {
                    response.set("Froxel-Compared", picture.compared);
                }
                done(onItsWay(std::move(response), picture.bytes));
            }
        },
        Clock::now());
    return [desk = desk_, ticket] { desk->cancel(ticket); };
}

HttpSite::CallOff StillAnswers::drawSeries(const Serving& serving,
                                           const Asked& asked,
                                           WantedStill wanted,
                                           const Tagged& tagged,
                                           const Done& done) const {
    const auto type = wanted.format->content_type;
    const auto sheet = wanted.format->facts ? std::nullopt : std::optional(wanted.format->codec);
    const auto series = std::make_shared<StillSeries>(
        StillSeries::Plan{std::move(wanted.views), std::move(wanted.still), sheet}, desk_,
        long_work_, asked.caller.limited(),
        [done, tagged, type, any = !asked.guest && hasAnything(asked.request),
         guest = asked.guest](StillSeries::Made made) {
            if (const auto* refusal = std::get_if<still::StillRefusal>(&made)) {
                done({refusedBy(*refusal, false)});
            } else if (any) {
                done({tagged(makeResponse(http::status::not_modified, type, {}))});
            } else if (auto* text = std::get_if<std::string>(&made)) {
                done({tagged(makeResponse(http::status::ok, type, std::move(*text)))});
            } else {
                done(onItsWay(tagged(makeResponse(http::status::ok, type, {})),
                              std::get<SharedBytes>(made)));
            }
        });
    return series->start({serving.context, serving.port, serving.scenes}, Clock::now());
}

} // namespace froxel::net

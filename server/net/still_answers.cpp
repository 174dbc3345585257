#include "net/still_answers.h"

#include "core/text.h"
#include "net/request_form.h"
#include "net/scene_listing.h"
#include "session/state_message.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>

namespace froxel::net {

namespace http = boost::beast::http;

namespace {

struct Format {
    std::string_view name;
    settings::Codec codec;
    std::string_view content_type;
};

// The first where none is named.
constexpr std::array kFormats{
    Format{"jpg", settings::Codec::kJpeg, "image/jpeg"},
    Format{"png", settings::Codec::kPng, "image/png"},
    Format{"exr", settings::Codec::kExr, "image/x-exr"},
    Format{"pfm", settings::Codec::kPfm, "image/x-portable-floatmap"},
};

std::string_view viewOf(boost::beast::string_view text) {
    return {text.data(), text.size()};
}

const Format& formatOf(settings::Codec codec) {
    return *std::ranges::find(kFormats, codec, &Format::codec);
}

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
                           std::shared_ptr<const Service> service)
    : desk_(std::move(desk)), catalogue_(std::move(catalogue)), service_(std::move(service)),
      run_(numberText(std::random_device()())) {}

bool StillAnswers::has(std::string_view path) {
    return path == kStillPath || !sceneOfThumbnail(path).empty();
}

// Without a catalogue nobody knows of what file a server was started.
std::string StillAnswers::sceneTag(const std::string& scene) const {
    const auto offered = !catalogue_     ? std::nullopt
                         : scene.empty() ? std::optional(catalogue_->listing()->scenes().front())
                                         : catalogue_->find(scene);
    return offered ? offered->id + " " + numberText(offered->version) : run_;
}

bool StillAnswers::lasts(const Request& request, const still::StillRequest& still) const {
    const auto offered =
        still.thumbnail && catalogue_ ? catalogue_->find(still.scene) : std::nullopt;
    return offered && viewOf(request.target()).ends_with(fmt::format("?v={:x}", offered->version));
}

std::optional<Response> StillAnswers::read(const Request& request,
                                           std::string_view path,
                                           still::StillRequest& still) const {
    still.scene = sceneOfThumbnail(path);
    still.thumbnail = !still.scene.empty();
    if (still.thumbnail) {
        still.view = {
            {"size", fmt::format("{}x{}", kThumbnailSize.width_px, kThumbnailSize.height_px)}};
        return {};
    }
    const auto target = targetOf(request);
    if (!target) {
        return refused(http::status::bad_request, "malformed", "", "the address is malformed");
    }
    for (const auto& said : target->params()) {
        const auto same = [&](const still::Entry& entry) { return entry.name == said.key; };
        if (std::ranges::any_of(still.view, same)) {
            return refused(http::status::bad_request, "out_of_range", printable(said.key),
                           "is given twice");
        }
        if (said.key == "scene") {
            still.scene = said.value;
        } else if (said.key == "format") {
            const auto format = std::ranges::find(kFormats, said.value, &Format::name);
            if (format == kFormats.end()) {
                std::array<std::string_view, kFormats.size()> names;
                std::ranges::transform(kFormats, names.begin(), &Format::name);
                return refused(http::status::bad_request, "unsupported", "format",
                               fmt::format("is \"{}\"; it must be {}", printable(said.value),
                                           fmt::join(names, ", ")));
            }
            still.codec = format->codec;
        } else {
            still.view.push_back({said.key, said.value});
        }
    }
    std::ranges::sort(still.view, {}, &still::Entry::name); // none stands for another order
    return {};
}

HttpSite::CallOff StillAnswers::answer(const Request& request,
                                       std::string_view path,
                                       const Caller& caller,
                                       bool shared,
                                       const std::function<void(LateAnswer)>& done) const {
    const auto nothing = [] {};
    const ServiceStatus status = service_->status();
    if (!status.serving || status.draining || status.lost) {
        Response response =
            refused(http::status::service_unavailable, "capacity", "",
                    status.serving ? "the server is going down" : "the scene is being loaded");
        response.set(http::field::retry_after, "5");
        done({std::move(response)});
        return nothing;
    }
    still::StillRequest still;
    if (auto refusal = read(request, path, still)) {
        done({std::move(*refusal)});
        return nothing;
    }
    const Serving& serving = *status.serving;
    const Format& format = formatOf(still.codec);
    still.tag = serving.context->server_version + "\n" + serving.context->device_name + "\n" +
                sceneTag(still.scene) + "\n" + std::string(format.name);
    for (const auto& [name, text] : still.view) {
        still.tag += "\n" + name + "=" + text;
    }
    const std::string etag = etagOf(still.tag);
    const std::string caching = std::string(shared ? "" : "private, ") +
                                (lasts(request, still) ? "max-age=86400" : "no-cache");
    const auto tagged = [etag, caching](Response response) {
        response.set(http::field::etag, etag);
        response.set(http::field::cache_control, caching);
        return response;
    };
    if (hasAlready(request, etag)) {
        done({tagged(makeResponse(http::status::not_modified, format.content_type, {}))});
        return nothing;
    }
    const bool thumbnail = still.thumbnail;
    const auto account =
        caller.local && !caller.token ? std::nullopt : std::optional(caller.account());
    const auto ticket = desk_->ask(
        {serving.context, serving.port, serving.scenes}, std::move(still), account,
        [done, tagged, &format, thumbnail](const still::StillOutcome& outcome) {
            if (const auto* refusal = std::get_if<still::StillRefusal>(&outcome)) {
                done({refusedBy(*refusal, thumbnail)});
                return;
            }
            done(onItsWay(tagged(makeResponse(http::status::ok, format.content_type, {})),
                          std::get<SharedBytes>(outcome)));
        },
        Clock::now());
    return [desk = desk_, ticket] { desk->cancel(ticket); };
}

} // namespace froxel::net

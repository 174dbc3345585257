#include "net/public_site.h"

#include "core/assert.h"
#include "core/text.h"
#include "net/link_preview.h"
#include "net/origin.h"
#include "net/request_form.h"
#include "net/ws_connection.h"
#include "protocol/limits.h"
#include "session/setting_words.h"

#include <boost/beast/http/rfc7230.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <utility>

namespace froxel::net {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

namespace {

Response noToken() {
    return unauthorized("Authorization must be Bearer and a token of this server");
}

Response file(const Request& request, const StaticFile& found, const std::string& policy) {
    const Representation& sent = found.bestFor(viewOf(request[http::field::accept_encoding]));
    Response response = taggedResponse(request, found.content_type, sent.body, sent.etag);
    const bool unchanged = response.result() == http::status::not_modified;
    response.set("Content-Security-Policy", policy);
    response.set(http::field::cache_control,
                 found.immutable ? "public, max-age=31536000, immutable" : "no-cache");
    if (!found.coded.empty()) {
        response.set(http::field::vary, "Accept-Encoding");
    }
    if (!sent.coding.empty() && !unchanged) {
        response.set(http::field::content_encoding,
                     beast::string_view(sent.coding.data(), sent.coding.size()));
    }
    return response;
}

// What the socket's URL says: ?room=NAME, ?resume=NAME.
Announcement announcementOf(const Request& request) {
    Announcement announcement;
    if (const auto target = targetOf(request)) {
        for (const auto& said : target->params()) {
            if (said.key == "room") {
                announcement.room = said.value;
            } else if (said.key == "resume") {
                announcement.resume = said.value;
            }
        }
    }
    return announcement;
}

// A proxy with TLS says so; a page cannot.
bool cameSecurely(const Request& request, const asio::ip::address& peer, const Site& site) {
    return site.encrypted || cameByTls(peer, viewOf(request["X-Forwarded-For"]),
                                       viewOf(request["X-Forwarded-Proto"]), site.trusted_proxies);
}

std::optional<std::string_view> fieldOf(const Request& request, beast::string_view name) {
    const auto found = request.find(name);
    return found == request.end() ? std::nullopt : std::optional(viewOf(found->value()));
}

Fetch fetchOf(const Request& request, const Site& site) {
    return net::fetchOf({fieldOf(request, "Sec-Fetch-Site"), fieldOf(request, "Sec-Fetch-Mode"),
                         fieldOf(request, "Sec-Fetch-Dest"), fieldOf(request, "Origin"),
                         fieldOf(request, "Referer")},
                        viewOf(request[http::field::host]), site.allowed_origins);
}

// A page of another site in a browser of this machine is no local caller: limits hold for it.
Caller callerOf(const Request& request, const asio::ip::address& peer, const Site& site) {
    Caller caller =
        callerAt(clientAddress(peer, viewOf(request["X-Forwarded-For"]), site.trusted_proxies));
    caller.local = caller.local && fetchOf(request, site) != Fetch::kForeign;
    return caller;
}

// Pages of other sites must not have the server work; none where this request may.
std::optional<Response> refuseForeign(const Request& request, const Site& site) {
    if (fetchOf(request, site) != Fetch::kForeign) {
        return {};
    }
    site.metrics->requestRefused(RequestRefusal::kForeign);
    return apiRefusal(http::status::forbidden, {"foreign", "",
                                                "pages of other sites may not request this; "
                                                "--allow-origin of froxel serve allows a site"});
}

// What a page of an allowed site needs beside the answer, lest its browser keep it back.
void letOthersRead(const Request& request, const Site& site, Response& response) {
    if (site.allowed_origins.empty()) {
        return;
    }
    response.set(http::field::vary, "Origin, Sec-Fetch-Site");
    if (fetchOf(request, site) == Fetch::kAllowed) {
        response.set("Cross-Origin-Resource-Policy", "cross-origin");
        if (const auto origin = fieldOf(request, "Origin")) {
            response.set(http::field::access_control_allow_origin,
                         beast::string_view(origin->data(), origin->size()));
        }
    }
}

// None where the token that the request shows, if it needs one, is wrong. Who guesses is told of,
// and has to wait.
std::optional<Caller>
admitted(const Request& request, const asio::ip::address& peer, const Site& site) {
    Caller caller = callerOf(request, peer, site);
    if (!site.gate) {
        return caller;
    }
    const std::string_view token = bearerToken(request);
    const auto pass = site.gate->admit(token);
    if (pass) {
        caller.token = pass->account();
        return caller;
    }
    if (!token.empty()) { // a page without one is none that guesses
        site.request_limits->onWrongToken(caller.address, Clock::now());
    }
    site.metrics->requestRefused(RequestRefusal::kToken);
    spdlog::warn("event=token_refused peer={} reason={}", caller.address.key,
                 token.empty() ? "missing" : "unknown");
    return {};
}

// A picture that everybody may ask for may be shown by any page, but not read by it (no CORS).
void letOthersShow(const Request& request, const Site& site, Response& response) {
    letOthersRead(request, site, response);
    if (!site.gate) {
        response.set("Cross-Origin-Resource-Policy", "cross-origin");
    }
}

// By which a page knows the reason of a refusal, as of a close.
constexpr std::string_view kCloseCodeField = "Froxel-Close-Code";

// None where its Hello would get a place, as far as can be told before.
std::optional<Response>
whyNoPlace(const Request& request, const asio::ip::address& peer, const Site& site) {
    const ServiceStatus status = site.service->status();
    if (status.draining) {
        return refusal(http::status::service_unavailable, "the server is going down");
    }
    // While it loads nobody has a place, and who gets one is found out then.
    if (!status.serving) {
        return {};
    }
    const auto let_in = site.lobby->admits(*status.serving, announcementOf(request),
                                           callerOf(request, peer, site), Clock::now());
    if (let_in) {
        return {};
    }
    auto response = refusal(http::status::service_unavailable, let_in.error().reason);
    response.set(kCloseCodeField, numberText(static_cast<uint16_t>(let_in.error().code)));
    return response;
}

// None where it may.
std::optional<Response>
whyNoUpgrade(const Request& request, const asio::ip::address& peer, const Site& site) {
    if (!isSocketPath(pathOf(request))) {
        return refusal(http::status::not_found, "the WebSocket is at /ws");
    }
    std::optional<std::string_view> origin;
    if (const auto found = request.find(http::field::origin); found != request.end()) {
        origin = viewOf(found->value());
    }
    const auto host = viewOf(request[http::field::host]);
    if (!originAllowed(origin, host, cameSecurely(request, peer, site), site.allowed_origins)) {
        return refusal(http::status::forbidden,
                       "origin " + printable(*origin) + " may not connect to " + printable(host));
    }
    const auto named = request.find(http::field::sec_websocket_protocol);
    if (named == request.end() || !http::token_list(named->value())
                                       .exists(beast::string_view(protocol::kSubprotocol.data(),
                                                                  protocol::kSubprotocol.size()))) {
        return refusal(http::status::bad_request, "the request must offer the subprotocol " +
                                                      std::string(protocol::kSubprotocol));
    }
    return whyNoPlace(request, peer, site);
}

// Who may ask for a route.
enum class Gate : uint8_t {
    kAll,
    kOwn,   // no page of another site, and nobody without a token where one is asked for
    kShown, // likewise; but pages of any site may where Site::shows_elsewhere
};

struct Asked {
    const Request& request;
    std::string_view path;
    const asio::ip::address& peer;
    const std::shared_ptr<const Site>& site;
    Caller caller; // who has passed the gate; of kAll nobody
};
using Done = std::function<void(LateAnswer)>;

// Of the first two handlers a route has one; the third is of those that a body may be sent to.
struct Route {
    bool (*has)(std::string_view path);
    Gate gate;
    Response (*now)(const Asked& asked);
    HttpSite::CallOff (*later)(const Asked& asked, const Done& done);
    HttpSite::Received (*receive)(const Asked& asked, uint64_t size_bytes) = nullptr;
    std::string_view methods = "GET, HEAD";
    http::verb received = http::verb::post; // the method of bodies
};

Response health(const Asked& asked) {
    const ServiceStatus status = asked.site->service->status();
    if (status.draining) {
        return makeResponse(http::status::service_unavailable, "application/json",
                            R"({"status":"draining"})");
    }
    return makeResponse(http::status::ok, "application/json",
                        status.serving ? R"({"status":"serving"})" : R"({"status":"loading"})");
}

// The page's tooltips.
Response settingWords(const Asked& /*asked*/) {
    Response response = makeResponse(http::status::ok, "application/json", session::settingWords());
    response.set(http::field::cache_control, "no-cache");
    return response;
}

Response sceneListing(const Asked& asked) {
    Response response = asked.site->scenes->answer(asked.request, asked.path);
    letOthersRead(asked.request, *asked.site, response);
    return response;
}

Response noMetrics(const Asked& /*asked*/) {
    return textResponse(http::status::not_found,
                        "metrics are at the admin address (froxel serve --admin-bind)");
}

Response socketAlone(const Asked& /*asked*/) {
    Response response = textResponse(http::status::upgrade_required,
                                     "this path supports only WebSocket (version 13)");
    response.set(http::field::upgrade, "websocket");
    return response;
}

Response pageFile(const Asked& asked) {
    if (const StaticFile* found = asked.site->files.find(asked.path)) {
        return file(asked.request, *found, asked.site->content_policy);
    }
    return textResponse(http::status::not_found,
                        asked.path == "/" ? "the page is not built; run ./deploy/build.sh"
                                          : "not found");
}

HttpSite::CallOff preview(const Asked& asked, const Done& done) {
    Response page = linkPreview(asked.request, cameSecurely(asked.request, asked.peer, *asked.site),
                                asked.site->gate == nullptr);
    letOthersShow(asked.request, *asked.site, page);
    done({std::move(page)});
    return [] {};
}

HttpSite::CallOff still(const Asked& asked, const Done& done) {
    return asked.site->stills->answer(
        {asked.request, std::string(asked.path), asked.caller, asked.site->gate == nullptr},
        [site = asked.site, request = asked.request, done](LateAnswer answer) {
            letOthersShow(request, *site, answer.response);
            done(std::move(answer));
        });
}

// A still of a scene that comes with the request.
HttpSite::Received guestStill(const Asked& asked, uint64_t size_bytes) {
    StillAnswers::Asked still{asked.request, std::string(asked.path), asked.caller};
    return asked.site->guest_bodies->receive(
        asked.caller.limited(), viewOf(asked.request[http::field::content_type]), size_bytes,
        [site = asked.site, still = std::move(still)](auto scene, const Done& done) {
            auto asked_of = still;
            asked_of.guest = std::move(scene);
            return site->stills->answer(asked_of,
                                        [site, request = still.request, done](LateAnswer answer) {
                                            letOthersRead(request, *site, answer.response);
                                            done(std::move(answer));
                                        });
        });
}

HttpSite::Received announceScene(const Asked& asked, uint64_t size_bytes) {
    return asked.site->uploads->announce(asked.caller.limited(), size_bytes);
}

// Below the listing's path: one scene, the server's or a client's.
bool isScene(std::string_view path) {
    return SceneListing::has(path) && path.size() > kScenesPath.size() + 1;
}

HttpSite::CallOff scene(const Asked& asked, const Done& done) {
    const std::string id(asked.path.substr(kScenesPath.size() + 1));
    if (asked.request.method() == http::verb::delete_) {
        return asked.site->uploads->removeScene(asked.request, id, done);
    }
    auto brought = asked.site->uploads->answerScene(id);
    done({brought ? std::move(*brought) : sceneListing(asked)});
    return [] {};
}

bool isUpload(std::string_view path) {
    return path.starts_with(kUploadsPath) && path.substr(kUploadsPath.size()).starts_with('/');
}

HttpSite::CallOff upload(const Asked& asked, const Done& done) {
    return asked.site->uploads->answer(asked.request, asked.path, done);
}

HttpSite::Received createUpload(const Asked& asked, uint64_t size_bytes) {
    return asked.site->uploads->create(asked.request, asked.caller.limited(), size_bytes);
}

HttpSite::Received receiveUpload(const Asked& asked, uint64_t size_bytes) {
    return asked.site->uploads->receive(asked.request, asked.path, size_bytes);
}

// The first that has a path answers it.
constexpr std::array kRoutes = {
    Route{[](std::string_view path) { return path == "/healthz"; }, Gate::kAll, health, nullptr},
    Route{[](std::string_view path) { return path == "/settings.json"; }, Gate::kAll, settingWords,
          nullptr},
    Route{[](std::string_view path) { return path == kStillPath; }, Gate::kShown, nullptr, still,
          guestStill, "GET, HEAD, POST"},
    // Thumbnails are below the listing's path.
    Route{StillAnswers::has, Gate::kShown, nullptr, still},
    Route{isScene, Gate::kOwn, nullptr, scene, nullptr, "GET, HEAD, DELETE"},
    Route{SceneListing::has, Gate::kOwn, sceneListing, nullptr, announceScene, "GET, HEAD, POST"},
    Route{[](std::string_view path) { return path == kUploadsPath; }, Gate::kOwn, nullptr, upload,
          createUpload, "OPTIONS, POST"},
    Route{isUpload, Gate::kOwn, nullptr, upload, receiveUpload, "OPTIONS, HEAD, PATCH, DELETE",
          http::verb::patch},
    Route{[](std::string_view path) { return path == kLinkPath; }, Gate::kAll, nullptr, preview},
    Route{[](std::string_view path) { return path == "/metrics"; }, Gate::kAll, noMetrics, nullptr},
    Route{isSocketPath, Gate::kAll, socketAlone, nullptr},
    Route{[](std::string_view) { return true; }, Gate::kAll, pageFile, nullptr}};

const Route& routeOf(std::string_view path) {
    return *std::ranges::find_if(kRoutes, [path](const Route& route) { return route.has(path); });
}

// None: it may pass, and `asked` says who it is.
std::optional<Response> refuseAt(Gate gate, Asked& asked) {
    if (gate == Gate::kAll) {
        return {};
    }
    if (gate == Gate::kOwn || !asked.site->shows_elsewhere) {
        if (auto refused = refuseForeign(asked.request, *asked.site)) {
            return refused;
        }
    }
    auto caller = admitted(asked.request, asked.peer, *asked.site);
    if (!caller) {
        return noToken();
    }
    asked.caller = std::move(*caller);
    return {};
}

} // namespace

Response PublicSite::answer(const Request& request,
                            std::string_view path,
                            const asio::ip::address& peer) const {
    const Route& route = routeOf(path);
    FROXEL_ASSERT(route.now != nullptr, "answerLater() has it");
    Asked asked{request, path, peer, site_, {}};
    auto refused = refuseAt(route.gate, asked);
    return refused ? std::move(*refused) : route.now(asked);
}

std::optional<HttpSite::CallOff>
PublicSite::answerLater(const Request& request,
                        std::string_view path,
                        const asio::ip::address& peer,
                        std::function<void(LateAnswer)> done) const {
    const Route& route = routeOf(path);
    if (route.later == nullptr) {
        return {};
    }
    Asked asked{request, path, peer, site_, {}};
    if (auto refused = refuseAt(route.gate, asked)) {
        done({std::move(*refused)});
        return [] {};
    }
    return route.later(asked, done);
}

std::string_view PublicSite::methodsOf(std::string_view path) const {
    return routeOf(path).methods;
}

bool PublicSite::takesBody(http::verb method, std::string_view path) const {
    const Route& route = routeOf(path);
    return route.receive != nullptr && method == route.received;
}

HttpSite::Received PublicSite::receive(const Request& request,
                                       std::string_view path,
                                       const asio::ip::address& peer,
                                       uint64_t size_bytes) const {
    Asked asked{request, path, peer, site_, {}};
    if (auto refused = refuseAt(Gate::kOwn, asked)) {
        return std::move(*refused);
    }
    return routeOf(path).receive(asked, size_bytes);
}

std::optional<Response> PublicSite::refuseUpgrade(const Request& request,
                                                  const asio::ip::address& peer) const {
    if (!beast::websocket::is_upgrade(request)) {
        return whyNoPlace(request, peer, *site_);
    }
    auto refused = whyNoUpgrade(request, peer, *site_);
    if (refused) {
        site_->metrics->upgradeRefused(refused->result_int());
        spdlog::warn("event=upgrade_refused status={} origin={} host={}", refused->result_int(),
                     logValue(viewOf(request[http::field::origin]), 80),
                     logValue(viewOf(request[http::field::host]), 80));
    }
    return refused;
}

// A wrong token counts for the address that shows it, a valid one for itself.
Seconds PublicSite::waitOf(const Request& request, const asio::ip::address& peer) const {
    const Caller caller = callerOf(request, peer, *site_);
    const auto pass = site_->gate ? site_->gate->admit(bearerToken(request)) : std::nullopt;
    const auto& token = pass ? pass->account() : caller.token;
    if (caller.local && !token) {
        return Seconds(0);
    }
    const Seconds wait = site_->request_limits->ask(token ? *token : caller.address, Clock::now());
    if (wait.count() > 0) {
        site_->metrics->requestRefused(RequestRefusal::kRate);
        spdlog::warn("event=requests_refused peer={} reason=\"more than {:g} a second\"",
                     caller.address.key, RequestLimits::kPerSecond);
    }
    return wait;
}

uint32_t PublicSite::connectionsMax(const asio::ip::address& peer) const {
    return callerAt(peer).local || site_->trusted_proxies.contains(peer)
               ? std::numeric_limits<uint32_t>::max()
               : site_->connections_per_address;
}

void PublicSite::onConnectionRefused() const {
    site_->metrics->connectionRefused();
}

void PublicSite::upgrade(PeerStream stream, Request request, ConnectionTicket ticket) const {
    Caller caller = callerOf(request, peerAddress(stream), *site_);
    std::make_shared<WsConnection>(std::move(stream), site_, std::move(ticket))
        ->start(std::move(request), std::move(caller));
}

} // namespace froxel::net

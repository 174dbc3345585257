#include "net/public_site.h"

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

#include <utility>

namespace froxel::net {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

namespace {

Response health(const ServiceStatus& status) {
    if (status.draining) {
        return makeResponse(http::status::service_unavailable, "application/json",
                            R"({"status":"draining"})");
    }
    return makeResponse(http::status::ok, "application/json",
                        status.serving ? R"({"status":"serving"})" : R"({"status":"loading"})");
}

Response noToken() {
    return unauthorized("Authorization must be Bearer and a token of this server");
}

std::string_view viewOf(beast::string_view text) {
    return {text.data(), text.size()};
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

} // namespace

Response PublicSite::answer(const Request& request,
                            std::string_view path,
                            const asio::ip::address& peer) const {
    if (path == "/healthz") {
        return health(site_->service->status());
    }
    if (path == "/settings.json") { // the page's tooltips
        Response response =
            makeResponse(http::status::ok, "application/json", session::settingWords());
        response.set(http::field::cache_control, "no-cache");
        return response;
    }
    if (SceneListing::has(path)) {
        if (auto refused = refuseForeign(request, *site_)) {
            return std::move(*refused);
        }
        if (!admitted(request, peer, *site_)) {
            return noToken();
        }
        Response response = site_->scenes->answer(request, path);
        letOthersRead(request, *site_, response);
        return response;
    }
    if (path == "/metrics") {
        return textResponse(http::status::not_found,
                            "metrics are at the admin address (froxel serve --admin-bind)");
    }
    if (isSocketPath(path)) {
        Response response = textResponse(http::status::upgrade_required,
                                         "this path supports only WebSocket (version 13)");
        response.set(http::field::upgrade, "websocket");
        return response;
    }
    if (const StaticFile* found = site_->files.find(path)) {
        return file(request, *found, site_->content_policy);
    }
    return textResponse(http::status::not_found,
                        path == "/" ? "the page is not built; run ./deploy/build.sh" : "not found");
}

std::optional<HttpSite::CallOff>
PublicSite::answerLater(const Request& request,
                        std::string_view path,
                        const asio::ip::address& peer,
                        std::function<void(LateAnswer)> done) const {
    if (path == kLinkPath) {
        Response preview =
            linkPreview(request, cameSecurely(request, peer, *site_), site_->gate == nullptr);
        letOthersShow(request, *site_, preview);
        done({std::move(preview)});
        return [] {};
    }
    if (!StillAnswers::has(path)) {
        return {};
    }
    if (!site_->shows_elsewhere) {
        if (auto refused = refuseForeign(request, *site_)) {
            done({std::move(*refused)});
            return [] {};
        }
    }
    const auto caller = admitted(request, peer, *site_);
    if (!caller) {
        done({noToken()});
        return [] {};
    }
    return site_->stills->answer(request, path, *caller, site_->gate == nullptr,
                                 [site = site_, request, done](LateAnswer answer) {
                                     letOthersShow(request, *site, answer.response);
                                     done(std::move(answer));
                                 });
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

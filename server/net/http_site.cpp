#include "net/http_site.h"

#include "core/text.h"

#include <boost/beast/core/string.hpp>
#include <boost/beast/http/rfc7230.hpp>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include <functional>
#include <utility>

namespace froxel::net {

namespace http = boost::beast::http;

namespace {

Response
answerTo(const Request& request, const HttpSite& site, const boost::asio::ip::address& peer) {
    const std::string_view methods = site.methodsOf(pathOf(request));
    if (!isOneOf(request, methods)) {
        const std::string allowed(methods);
        Response response =
            textResponse(http::status::method_not_allowed, "only " + allowed + " is answered here");
        response.set(http::field::allow, allowed);
        return response;
    }
    return site.answer(request, pathOf(request), peer);
}

} // namespace

HttpSite::Received HttpSite::receive(const Request& /*request*/,
                                     std::string_view /*path*/,
                                     const boost::asio::ip::address& /*peer*/,
                                     uint64_t /*size_bytes*/) const {
    return refusal(http::status::payload_too_large, "requests must not have a body");
}

bool isOneOf(const Request& request, std::string_view methods) {
    const auto method = request.method_string();
    return http::token_list({methods.data(), methods.size()}).exists(method);
}

std::string textOf(const nlohmann::ordered_json& json) {
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Response apiRefusal(http::status status, const ApiRefusal& refusal) {
    nlohmann::ordered_json body{
        {"code", refusal.code}, {"field", refusal.field}, {"message", refusal.message}};
    if (!refusal.fits.empty()) {
        body["fits"] = refusal.fits;
    }
    return makeResponse(status, "application/json", textOf(body));
}

std::string etagOf(const std::string& text) {
    return fmt::format("\"{:016x}\"", std::hash<std::string>()(text));
}

bool hasAnything(const Request& request) {
    return request[http::field::if_none_match] == "*";
}

// A list, of which proxies that compress weaken each (RFC 9110 section 13.1.2).
bool hasAlready(const Request& request, std::string_view etag) {
    return request[http::field::if_none_match].find(boost::beast::string_view(
               etag.data(), etag.size())) != boost::beast::string_view::npos;
}

Response taggedResponse(const Request& request,
                        std::string_view content_type,
                        const std::string& body,
                        const std::string& etag) {
    const bool unchanged = hasAlready(request, etag) || hasAnything(request);
    Response response = makeResponse(unchanged ? http::status::not_modified : http::status::ok,
                                     content_type, unchanged ? std::string() : body);
    response.set(http::field::etag, etag);
    return response;
}

std::string_view bearerToken(const Request& request) {
    constexpr std::string_view kScheme = "Bearer ";
    const auto field = request[http::field::authorization];
    const std::string_view text{field.data(), field.size()};
    return boost::beast::iequals(text.substr(0, kScheme.size()), kScheme)
               ? text.substr(kScheme.size())
               : std::string_view();
}

Response unauthorized(std::string line) {
    Response response = textResponse(http::status::unauthorized, std::move(line));
    response.set(http::field::www_authenticate, "Bearer");
    return response;
}

// The page's control panel brings styles of its own. Nobody may frame it.
std::string contentPolicy(std::string_view reconnect_url) {
    return "default-src 'self'; connect-src 'self' " + std::string(reconnect_url) +
           "; img-src 'self' blob: data:; style-src 'self' 'unsafe-inline'; "
           "worker-src 'self' blob:; object-src 'none'; base-uri 'none'; form-action 'none'; "
           "frame-ancestors 'none'";
}

boost::asio::ip::address peerAddress(const PeerStream& stream) {
    boost::beast::error_code gone;
    return stream.next_layer().socket().remote_endpoint(gone).address();
}

std::optional<Response> refuseHost(const Request& request, const HttpSite& site) {
    const auto field = request[http::field::host];
    const std::string_view host{field.data(), field.size()};
    if (site.hostNames().contain(host)) {
        return {};
    }
    return refusal(http::status::misdirected_request,
                   "host " + printable(host) +
                       " is not accepted; it must be localhost, an IP address or a name given by "
                       "--allow-host");
}

std::string_view pathOf(const Request& request) {
    const std::string_view target{request.target().data(), request.target().size()};
    return target.substr(0, target.find('?'));
}

Response
respond(const Request& request, const HttpSite& site, const boost::asio::ip::address& peer) {
    return finished(request, LateAnswer{answerTo(request, site, peer)}).response;
}

LateAnswer finished(const Request& request, LateAnswer answer) {
    Response& response = answer.response;
    const bool keep_alive = request.keep_alive() && response.keep_alive();
    response.version(request.version());
    response.keep_alive(keep_alive);
    const size_t body_bytes = answer.picture ? answer.picture->size() : response.body().size();
    if (request.method() == http::verb::head) {
        response.body().clear();
        answer.picture.reset();
    }
    if (response.result() != http::status::not_modified &&
        response.result() != http::status::no_content) {
        response.content_length(body_bytes);
    }
    return answer;
}

Response makeResponse(http::status status, std::string_view content_type, std::string body) {
    Response response{status, 11};
    response.set(http::field::content_type,
                 boost::beast::string_view(content_type.data(), content_type.size()));
    response.set("Content-Security-Policy", contentPolicy({}));
    response.set("X-Content-Type-Options", "nosniff");
    response.set("X-Frame-Options", "DENY");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Opener-Policy", "same-origin");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    response.set(http::field::cache_control, "no-store");
    response.body() = std::move(body);
    return response;
}

Response textResponse(http::status status, std::string line) {
    return makeResponse(status, "text/plain; charset=utf-8", std::move(line) + "\n");
}

Response refusal(http::status status, std::string line) {
    Response response = textResponse(status, std::move(line));
    response.keep_alive(false);
    if (status == http::status::service_unavailable) {
        response.set(http::field::retry_after, "5");
    }
    response.prepare_payload();
    return response;
}

} // namespace froxel::net

#include "net/http_routes.h"

#include <utility>

namespace froxel::net {

namespace http = boost::beast::http;

namespace {

// The page needs its own scripts, its worker, its socket and pictures made in memory; its control
// panel brings styles of its own. Nobody may frame it.
constexpr std::string_view kContentPolicy =
    "default-src 'self'; img-src 'self' blob: data:; style-src 'self' 'unsafe-inline'; "
    "worker-src 'self' blob:; object-src 'none'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'";

Response make(http::status status, std::string_view content_type, std::string body) {
    Response response{status, 11};
    response.set(http::field::content_type, content_type);
    response.set("Content-Security-Policy", kContentPolicy);
    response.set("X-Content-Type-Options", "nosniff");
    response.set("X-Frame-Options", "DENY");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Opener-Policy", "same-origin");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    response.set(http::field::cache_control, "no-store");
    response.body() = std::move(body);
    return response;
}

Response text(http::status status, std::string line) {
    return make(status, "text/plain; charset=utf-8", std::move(line) + "\n");
}

Response health(const ServiceStatus& status) {
    if (status.draining) {
        return make(http::status::service_unavailable, "application/json",
                    R"({"status":"draining"})");
    }
    return make(http::status::ok, "application/json",
                status.serving ? R"({"status":"serving"})" : R"({"status":"loading"})");
}

Response file(const Request& request, const StaticFile& found) {
    const bool unchanged = request[http::field::if_none_match] == found.etag;
    Response response = make(unchanged ? http::status::not_modified : http::status::ok,
                             found.content_type, unchanged ? std::string() : found.body);
    response.set(http::field::etag, found.etag);
    response.set(http::field::cache_control,
                 found.immutable ? "public, max-age=31536000, immutable" : "no-cache");
    return response;
}

Response route(const Request& request, const Site& site) {
    if (request.method() != http::verb::get && request.method() != http::verb::head) {
        Response response =
            text(http::status::method_not_allowed, "only GET and HEAD are answered here");
        response.set(http::field::allow, "GET, HEAD");
        return response;
    }
    const std::string_view path = pathOf(request);
    if (path == "/healthz") {
        return health(site.service->status());
    }
    if (path == "/metrics") {
        return make(http::status::ok, Metrics::kContentType, site.metrics->text());
    }
    if (path == kSocketPath) {
        Response response =
            text(http::status::upgrade_required, "this path speaks WebSocket (version 13) only");
        response.set(http::field::upgrade, "websocket");
        return response;
    }
    if (const StaticFile* found = site.files.find(path)) {
        return file(request, *found);
    }
    return text(http::status::not_found,
                path == "/" ? "the page is not built; ./deploy/build.sh makes it" : "not found");
}

} // namespace

std::string_view pathOf(const Request& request) {
    const std::string_view target{request.target().data(), request.target().size()};
    return target.substr(0, target.find('?'));
}

Response respond(const Request& request, const Site& site) {
    Response response = route(request, site);
    response.version(request.version());
    response.keep_alive(request.keep_alive());
    const size_t body_bytes = response.body().size();
    if (request.method() == http::verb::head) {
        response.body().clear();
    }
    if (response.result() != http::status::not_modified) {
        response.content_length(body_bytes);
    }
    return response;
}

Response refusal(http::status status, std::string line) {
    Response response = text(status, std::move(line));
    response.keep_alive(false);
    if (status == http::status::service_unavailable) {
        response.set(http::field::retry_after, "5");
    }
    response.prepare_payload();
    return response;
}

} // namespace froxel::net

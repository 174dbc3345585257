#include "net/admin_site.h"

#include "core/assert.h"
#include "net/health.h"
#include "session/room.h"

#include <algorithm>

namespace froxel::net {

namespace http = boost::beast::http;

namespace {

constexpr std::string_view kTakeControl = "/take-control";

Response verdict(const Result<void>& well) {
    return well ? textResponse(http::status::ok, "ok")
                : textResponse(http::status::service_unavailable, well.error().message);
}

} // namespace

const std::array<AdminSite::Route, 6> AdminSite::kRoutes = {{
    {[](std::string_view path) { return path == kMetricsPath; }, Method::kRead,
     &AdminSite::metricsText},
    {[](std::string_view path) { return path == kLivePath; }, Method::kRead, &AdminSite::live},
    {[](std::string_view path) { return path == kReadyPath; }, Method::kRead, &AdminSite::ready},
    {[](std::string_view path) { return path == kStartedPath; }, Method::kRead,
     &AdminSite::started},
    {[](std::string_view path) { return path == kDrainPath; }, Method::kPost, &AdminSite::drain},
    {[](std::string_view path) { return roomIn(path).has_value(); }, Method::kPost,
     &AdminSite::takeControl},
}};

const AdminSite::Route* AdminSite::routeOf(std::string_view path) {
    const auto* const route =
        std::ranges::find_if(kRoutes, [path](const Route& one) { return one.has(path); });
    return route == kRoutes.end() ? nullptr : route;
}

std::string_view AdminSite::methodsOf(std::string_view path) const {
    const Route* const route = routeOf(path);
    return route != nullptr && route->method == Method::kPost ? "POST" : "GET, HEAD";
}

Response AdminSite::answer(const Request& request,
                           std::string_view path,
                           const boost::asio::ip::address& /*peer*/) const {
    const Route* const route = routeOf(path);
    if (route == nullptr) {
        return textResponse(http::status::not_found,
                            "not found; available are /metrics, /livez, /readyz, /startupz, "
                            "/drain and /rooms/NAME/take-control");
    }
    if (route->method == Method::kPost) {
        if (auto refused = refusePost(request)) {
            return std::move(*refused);
        }
    }
    return (this->*route->answer)(path);
}

Response AdminSite::metricsText(std::string_view /*path*/) const {
    return makeResponse(http::status::ok, Metrics::kContentType, metrics_->text());
}

Response AdminSite::live(std::string_view /*path*/) const {
    return verdict(isLive(service_->status(), hooks_.network_moves, Clock::now()));
}

Response AdminSite::ready(std::string_view /*path*/) const {
    return verdict(isReady(service_->status(), Clock::now()));
}

Response AdminSite::started(std::string_view /*path*/) const {
    return verdict(hasStarted(service_->status()));
}

Response AdminSite::drain(std::string_view /*path*/) const {
    hooks_.drain();
    return textResponse(http::status::accepted, "draining");
}

std::optional<std::string> AdminSite::roomIn(std::string_view path) {
    if (path.size() <= kRoomsPath.size() + kTakeControl.size() || !path.starts_with(kRoomsPath) ||
        !path.ends_with(kTakeControl)) {
        return {};
    }
    path.remove_prefix(kRoomsPath.size());
    path.remove_suffix(kTakeControl.size());
    return session::isRoomName(path) ? std::optional(std::string(path)) : std::nullopt;
}

Response AdminSite::takeControl(std::string_view path) const {
    const std::string room = roomIn(path).value();
    return hooks_.take_control(room)
               ? textResponse(http::status::ok, "control of room " + room + " was taken")
               : textResponse(http::status::not_found, "nobody is in room " + room);
}

// A page of any site can make a browser on this machine post here; none sends this without Origin.
std::optional<Response> AdminSite::refusePost(const Request& request) const {
    if (request.count(http::field::origin) > 0) {
        return textResponse(http::status::forbidden, "browsers may not send this request");
    }
    if (!access_.tokens && !access_.loopback) {
        return textResponse(
            http::status::forbidden,
            "this needs --admin-token-file, because other machines reach this address");
    }
    if (access_.tokens && !access_.tokens->lets(bearerToken(request))) {
        return unauthorized("Authorization must be Bearer and a token of --admin-token-file");
    }
    return {};
}

std::optional<Response> AdminSite::refuseUpgrade(const Request& /*request*/,
                                                 const boost::asio::ip::address& /*peer*/) const {
    return refusal(http::status::not_found, "the admin address has no WebSocket");
}

void AdminSite::upgrade(PeerStream /*stream*/,
                        Request /*request*/,
                        ConnectionTicket /*ticket*/) const {
    FROXEL_ASSERT(false, "every upgrade is refused");
}

} // namespace froxel::net

#include "net/admin_site.h"

#include "core/assert.h"
#include "net/health.h"

namespace froxel::net {

namespace http = boost::beast::http;

namespace {

Response verdict(const Result<void>& well) {
    return well ? textResponse(http::status::ok, "ok")
                : textResponse(http::status::service_unavailable, well.error().message);
}

} // namespace

Response AdminSite::answer(const Request& request, std::string_view path) const {
    if (path == kMetricsPath) {
        return makeResponse(http::status::ok, Metrics::kContentType, metrics_->text());
    }
    if (path == kLivePath) {
        return verdict(isLive(service_->status(), hooks_.network_moves, Clock::now()));
    }
    if (path == kReadyPath) {
        return verdict(isReady(service_->status(), Clock::now()));
    }
    if (path == kStartedPath) {
        return verdict(hasStarted(service_->status()));
    }
    if (path == kDrainPath) {
        return drain(request);
    }
    return textResponse(http::status::not_found,
                        "not found; there are /metrics, /livez, /readyz, /startupz and /drain");
}

// A page of any site can make a browser on this machine post here; none sends this without Origin.
Response AdminSite::drain(const Request& request) const {
    if (request.count(http::field::origin) > 0) {
        return textResponse(http::status::forbidden, "a browser may not drain a server");
    }
    hooks_.drain();
    return textResponse(http::status::accepted, "draining");
}

std::optional<Response> AdminSite::refuseUpgrade(const Request& /*request*/) const {
    return refusal(http::status::not_found, "no WebSocket at the admin address");
}

void AdminSite::upgrade(PeerStream /*stream*/,
                        Request /*request*/,
                        ConnectionTicket /*ticket*/) const {
    FROXEL_ASSERT(false, "every upgrade is refused");
}

} // namespace froxel::net

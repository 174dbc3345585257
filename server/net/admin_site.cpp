#include "net/admin_site.h"

#include "core/assert.h"

namespace froxel::net {

namespace http = boost::beast::http;

Response AdminSite::answer(const Request& /*request*/, std::string_view path) const {
    if (path == "/metrics") {
        return makeResponse(http::status::ok, Metrics::kContentType, metrics_->text());
    }
    return textResponse(http::status::not_found, "not found; there is /metrics");
}

std::optional<Response> AdminSite::refuseUpgrade(const Request& /*request*/) const {
    return refusal(http::status::not_found, "no WebSocket at the admin address");
}

void AdminSite::upgrade(boost::beast::tcp_stream /*stream*/,
                        Request /*request*/,
                        ConnectionTicket /*ticket*/) const {
    FROXEL_ASSERT(false, "every upgrade is refused");
}

} // namespace froxel::net

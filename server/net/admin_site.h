// The address that operators use: the metrics. No WebSocket, and no page.
#pragma once

#include "net/http_site.h"
#include "net/metrics.h"

#include <memory>

namespace froxel::net {

class AdminSite final : public HttpSite {
  public:
    explicit AdminSite(std::shared_ptr<const Metrics> metrics) : metrics_(std::move(metrics)) {}

    [[nodiscard]] Response answer(const Request& request, std::string_view path) const override;
    [[nodiscard]] std::optional<Response> refuseUpgrade(const Request& request) const override;
    void upgrade(boost::beast::tcp_stream stream,
                 Request request,
                 ConnectionTicket ticket) const override;
    void onConnectionRefused() const override {}
    // A scrape may come while viewers are being told to go.
    [[nodiscard]] Service* drainsWith() const override { return nullptr; }

  private:
    const std::shared_ptr<const Metrics> metrics_;
};

} // namespace froxel::net

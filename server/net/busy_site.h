// What a connection over the limit is told, whatever it asks for.
#pragma once

#include "core/assert.h"
#include "net/http_site.h"

namespace froxel::net {

class BusySite final : public HttpSite {
  public:
    [[nodiscard]] const HostNames& hostNames() const override { return any_; }
    [[nodiscard]] Response answer(const Request& /*request*/,
                                  std::string_view /*path*/,
                                  const boost::asio::ip::address& /*peer*/) const override {
        return refused();
    }
    [[nodiscard]] std::optional<Response>
    refuseUpgrade(const Request& /*request*/,
                  const boost::asio::ip::address& /*peer*/) const override {
        return refused();
    }
    void upgrade(PeerStream /*stream*/,
                 Request /*request*/,
                 ConnectionTicket /*ticket*/) const override {
        FROXEL_ASSERT(false, "every upgrade is refused");
    }
    void onConnectionRefused() const override {}
    [[nodiscard]] Service* drainsWith() const override { return nullptr; }

  private:
    const HostNames any_{};

    static Response refused() {
        return refusal(boost::beast::http::status::service_unavailable,
                       "this server accepts no more connections now; try again later");
    }
};

} // namespace froxel::net

// The address that viewers use: the page, its health, and the WebSocket.
#pragma once

#include "net/facts.h"
#include "net/http_site.h"
#include "net/site.h"

#include <memory>

namespace froxel::net {

class PublicSite final : public HttpSite {
  public:
    explicit PublicSite(std::shared_ptr<const Site> site) : site_(std::move(site)) {}

    [[nodiscard]] const HostNames& hostNames() const override { return site_->host_names; }
    [[nodiscard]] Response answer(const Request& request,
                                  std::string_view path,
                                  const boost::asio::ip::address& peer) const override;
    [[nodiscard]] Seconds waitOf(const Request& request,
                                 const boost::asio::ip::address& peer) const override;
    [[nodiscard]] std::optional<CallOff>
    answerLater(const Request& request,
                std::string_view path,
                const boost::asio::ip::address& peer,
                std::function<void(LateAnswer)> done) const override;
    [[nodiscard]] std::string_view methodsOf(std::string_view path) const override;
    [[nodiscard]] bool takesBody(boost::beast::http::verb method,
                                 std::string_view path) const override;
    [[nodiscard]] LongWork* longWork() const override { return site_->long_work; }
    [[nodiscard]] Received receive(const Request& request,
                                   std::string_view path,
                                   const boost::asio::ip::address& peer,
                                   uint64_t size_bytes) const override;
    [[nodiscard]] std::optional<Response>
    refuseUpgrade(const Request& request, const boost::asio::ip::address& peer) const override;
    [[nodiscard]] uint32_t connectionsMax(const boost::asio::ip::address& peer) const override;
    void upgrade(PeerStream stream, Request request, ConnectionTicket ticket) const override;
    void onConnectionRefused() const override;
    [[nodiscard]] Service* drainsWith() const override { return site_->service.get(); }

  private:
    const std::shared_ptr<const Site> site_;
};

} // namespace froxel::net

// The address that operators use: metrics, health, and draining. No WebSocket, and no page.
#pragma once

#include "net/facts.h"
#include "net/http_site.h"
#include "net/metrics.h"
#include "net/token_gate.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace froxel::net {

struct AdminHooks {
    // Whether the network threads take work; may wait for a second.
    std::function<bool()> network_moves = [] { return true; };
    // As SIGTERM does; must not block.
    std::function<void()> drain = [] {};
    // As Lobby::takeControl.
    std::function<bool(const std::string&)> take_control = [](const std::string&) { return false; };
};

// Whom it answers, and what.
struct AdminAccess {
    HostNames host_names;
    bool loopback = true;                    // only this host's own programs reach it
    std::shared_ptr<const TokenGate> tokens; // one is asked for to POST; null: none
};

class AdminSite final : public HttpSite {
  public:
    AdminSite(std::shared_ptr<const Metrics> metrics,
              std::shared_ptr<const Service> service,
              AdminHooks hooks,
              AdminAccess access = {})
        : metrics_(std::move(metrics)), service_(std::move(service)), hooks_(std::move(hooks)),
          access_(std::move(access)) {}

    [[nodiscard]] const HostNames& hostNames() const override { return access_.host_names; }

    [[nodiscard]] Response answer(const Request& request,
                                  std::string_view path,
                                  const boost::asio::ip::address& peer) const override;
    [[nodiscard]] std::string_view methodsOf(std::string_view path) const override;
    [[nodiscard]] std::optional<Response>
    refuseUpgrade(const Request& request, const boost::asio::ip::address& peer) const override;
    void upgrade(PeerStream stream, Request request, ConnectionTicket ticket) const override;
    void onConnectionRefused() const override {}
    // A scrape may come while viewers are being told to go.
    [[nodiscard]] Service* drainsWith() const override { return nullptr; }

  private:
    enum class Method : uint8_t { kRead, kPost }; // GET and HEAD; POST alone, past refusePost()
    struct Route {
        bool (*has)(std::string_view path);
        Method method;
        Response (AdminSite::*answer)(std::string_view path) const;
    };
    static const std::array<Route, 6> kRoutes;
    [[nodiscard]] static const Route* routeOf(std::string_view path);

    [[nodiscard]] Response metricsText(std::string_view path) const;
    [[nodiscard]] Response live(std::string_view path) const;
    [[nodiscard]] Response ready(std::string_view path) const;
    [[nodiscard]] Response started(std::string_view path) const;
    [[nodiscard]] Response drain(std::string_view path) const;
    [[nodiscard]] Response takeControl(std::string_view path) const;

    // Of "/rooms/NAME/take-control".
    [[nodiscard]] static std::optional<std::string> roomIn(std::string_view path);
    // None: whoever asks may POST.
    [[nodiscard]] std::optional<Response> refusePost(const Request& request) const;

    const std::shared_ptr<const Metrics> metrics_;
    const std::shared_ptr<const Service> service_;
    const AdminHooks hooks_;
    const AdminAccess access_;
};

} // namespace froxel::net

// The network room's door: the listeners, their threads, and what all connections share.
#pragma once

#include "guest/guest_shelf.h"
#include "guest/guest_store.h"
#include "net/agones.h"
#include "net/bind_address.h"
#include "net/lobby_rules.h"
#include "net/service.h"
#include "still/still_desk.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace froxel::catalogue {
class Catalogue;
}

namespace froxel::net {

class Metrics;
class Tls;
class TokenGate;

struct ServerOptions {
    std::string version = "unknown"; // of the server, for the metrics
    BindAddress bind{"127.0.0.1", 0};
    BindAddress admin; // for operators: metrics and health; an empty address: none
    std::function<void()> on_drain_request = [] {}; // by an operator; any thread, must not block
    uint32_t thread_count = 1;
    // Of any kind, half of them from one address, as LobbyRules; sessions have limits of their own.
    uint32_t connections_max = 512;
    LobbyRules lobby;
    still::StillLimits stills;
    std::filesystem::path web_root; // empty: no page
    std::shared_ptr<const catalogue::Catalogue>
        catalogue; // of the server's own scenes; null: it has one
    // Where scenes that clients bring are found by whoever loads them.
    std::shared_ptr<guest::GuestShelf> guests = std::make_shared<guest::GuestShelf>();
    // Of one that comes in the body of a request; 0: none may.
    uint64_t guest_body_bytes = uint64_t{64} << 20U;
    // Of scenes that clients bring and that stay; null: none may.
    std::shared_ptr<guest::GuestStore> guest_store{};
    std::vector<std::string> allowed_origins;
    std::vector<std::string> trusted_proxies;    // networks, as TrustedProxies::parse
    std::vector<std::string> host_names;         // answered to at both addresses, see HostNames
    std::shared_ptr<const TokenGate> gate;       // null: everybody is let in
    std::shared_ptr<const TokenGate> admin_gate; // of the admin address, see AdminAccess
    std::shared_ptr<const Tls> tls;      // of the viewers' address; null: without encryption
    std::optional<AgonesOptions> agones; // whose SDK is told of this server; none: nobody's
    std::string reconnect_url;           // where pages are sent when this server drains, or empty
};

class Server {
  public:
    // Listens and answers at once, in the loading state. Throws StartupError: kAddressInUse, kIo.
    explicit Server(const ServerOptions& options);
    // Drops what is left of the connections.
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    [[nodiscard]] uint16_t port() const;
    // None without an admin address.
    [[nodiscard]] std::optional<uint16_t> adminPort() const;
    // Where progress, readiness and draining are told. Any thread.
    [[nodiscard]] Service& service();
    [[nodiscard]] Metrics& metrics();

    // From now on no session begins: who asks for one is told to come back. Viewers are told when
    // it ends and where to go meanwhile; a part of the deadline is left to close those that stay.
    // Returns when the last one has closed, at the deadline at the latest, though never before
    // those that stay can have heard of it; whether all had. The admin address answers to the end.
    // Agones is told after it, which may take 2 s more.
    bool drain(std::chrono::milliseconds deadline);
    // Tells every viewer that no picture comes any more, and waits for at most a second until they
    // have heard it.
    void giveUp(const std::string& why);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace froxel::net

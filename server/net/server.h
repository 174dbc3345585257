// The network room's door: the listeners, their threads, and what all connections share.
#pragma once

#include "net/bind_address.h"
#include "net/service.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace froxel::net {

class Metrics;

struct ServerOptions {
    std::string version = "unknown"; // of the server, for the metrics
    BindAddress bind{"127.0.0.1", 0};
    BindAddress admin; // for operators: metrics; an empty address: none
    uint32_t thread_count = 1;
    uint32_t connections_max = 512; // of any kind; sessions have a limit of their own
    // How long the session of a lost connection waits for it; 0: not at all.
    std::chrono::milliseconds resume_grace{0};
    std::filesystem::path web_root; // empty: no page
    std::vector<std::string> allowed_origins;
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

    // Accepts no more, tells everyone, and waits until the last connection has closed or the
    // deadline is over; whether all closed by themselves. The admin address answers to the end.
    bool drain(std::chrono::milliseconds deadline);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace froxel::net

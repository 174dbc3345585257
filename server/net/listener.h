// Accepts connections and gives each a strand of its own.
#pragma once

#include "net/bind_address.h"
#include "net/http_site.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include <atomic>
#include <memory>
#include <string>

namespace froxel::net {

class Listener final : public std::enable_shared_from_this<Listener> {
  public:
    // Listens at once. Throws StartupError: kAddressInUse, kIo (no such address here); the message
    // names `option`, by which another port is chosen.
    Listener(boost::asio::io_context& io,
             const BindAddress& bind,
             const char* option,
             uint32_t connections_max,
             std::shared_ptr<const HttpSite> site);

    [[nodiscard]] uint16_t port() const { return port_; }
    void start();
    // Any thread.
    void stop();

  private:
    void accept();
    void onAccepted(boost::system::error_code error, boost::asio::ip::tcp::socket socket);

    boost::asio::io_context& io_;
    boost::asio::ip::tcp::acceptor acceptor_; // on a strand of its own
    boost::asio::steady_timer back_off_;
    const uint32_t connections_max_;
    const std::shared_ptr<const HttpSite> site_;
    const std::shared_ptr<std::atomic<uint32_t>> connection_count_;
    uint16_t port_ = 0;
};

} // namespace froxel::net

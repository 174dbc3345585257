// Accepts connections and gives each a strand of its own.
#pragma once

#include "net/bind_address.h"
#include "net/http_site.h"
#include "net/tls.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

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
             std::shared_ptr<const HttpSite> site,
             std::shared_ptr<const Tls> tls = nullptr);

    [[nodiscard]] uint16_t port() const { return port_; }
    void start();
    // Any thread.
    void stop();

  private:
    void accept();
    void onAccepted(boost::system::error_code error, boost::asio::ip::tcp::socket socket);
    void serve(boost::asio::ip::tcp::socket socket,
               std::shared_ptr<const HttpSite> site,
               ConnectionTicket ticket);

    boost::asio::io_context& io_;
    boost::asio::ip::tcp::acceptor acceptor_; // on a strand of its own
    boost::asio::steady_timer back_off_;
    const uint32_t connections_max_;
    const std::shared_ptr<const HttpSite> site_;
    const std::shared_ptr<const HttpSite> busy_site_;
    const std::shared_ptr<const Tls> tls_; // null: without encryption
    ConnectionTickets tickets_;
    ConnectionTickets refused_tickets_; // of those that are told so
    uint16_t port_ = 0;
};

} // namespace froxel::net

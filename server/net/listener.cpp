#include "net/listener.h"

#include "core/error.h"
#include "core/text.h"
#include "net/busy_site.h"
#include "net/guard.h"
#include "net/http_session.h"

#include <boost/asio/post.hpp>
#include <boost/asio/strand.hpp>

#include <netinet/tcp.h>
#include <sys/socket.h>
#include <utility>

namespace froxel::net {

namespace asio = boost::asio;
using asio::ip::tcp;
using Failure = boost::system::error_code;

namespace {

// How long to leave the queue alone when the process has no descriptor or memory left.
constexpr std::chrono::milliseconds kBackOff{100};
// Connections over the limit that are told so at a time; more are closed unanswered.
constexpr uint32_t kRefusedMax = 64;
// Unsent bytes that the kernel may hold for one connection: what waits there grows old.
constexpr int kNotSentBytes = 128 * 1024;
// A peer that is gone without a word (its cable was pulled) is given up after this: Linux would try
// for a quarter of an hour.
constexpr int kUnacknowledged_ms = 10'000;

[[noreturn]] void
refuseStart(const BindAddress& bind, const std::string& option, const Failure& failure) {
    const bool taken = failure == asio::error::address_in_use;
    throw StartupError(
        {taken ? ErrorCode::kAddressInUse : ErrorCode::kIo,
         "cannot listen on " + bind.address + " port " + numberText(bind.port) + ": " +
             (taken ? "it is in use; choose another with " + option : failure.message())});
}

bool outOfResources(const Failure& failure) {
    return failure == asio::error::no_descriptors || failure == asio::error::no_memory ||
           failure == asio::error::no_buffer_space ||
           failure == boost::system::errc::too_many_files_open_in_system;
}

void tune(tcp::socket& socket) {
    Failure ignored; // a socket that closed meanwhile fails at its first read
    socket.set_option(tcp::no_delay(true), ignored);
    using NotSentLowWater = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_NOTSENT_LOWAT>;
    socket.set_option(NotSentLowWater(kNotSentBytes), ignored);
    using UserTimeout = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_USER_TIMEOUT>;
    socket.set_option(UserTimeout(kUnacknowledged_ms), ignored);
}

} // namespace

Listener::Listener(asio::io_context& io,
                   const BindAddress& bind,
                   const char* option,
                   uint32_t connections_max,
                   std::shared_ptr<const HttpSite> site,
                   std::shared_ptr<const Tls> tls)
    : io_(io), acceptor_(asio::make_strand(io)), back_off_(acceptor_.get_executor()),
      connections_max_(connections_max), site_(std::move(site)),
      busy_site_(std::make_shared<BusySite>()), tls_(std::move(tls)), tickets_(connections_max),
      refused_tickets_(kRefusedMax) {
    Failure failure;
    const auto ip = asio::ip::make_address(bind.address, failure);
    if (failure) {
        throw StartupError({ErrorCode::kIo, "address \"" + printable(bind.address) +
                                                "\" is not an IPv4 or IPv6 address"});
    }
    const tcp::endpoint endpoint(ip, bind.port);
    acceptor_.open(endpoint.protocol(), failure);
    if (!failure) {
        acceptor_.set_option(asio::socket_base::reuse_address(true), failure);
    }
    if (!failure) {
        acceptor_.bind(endpoint, failure);
    }
    if (!failure) {
        acceptor_.listen(asio::socket_base::max_listen_connections, failure);
    }
    if (failure) {
        refuseStart(bind, option, failure);
    }
    port_ = acceptor_.local_endpoint().port();
}

void Listener::start() {
    asio::post(acceptor_.get_executor(), [self = shared_from_this()] { self->accept(); });
}

void Listener::stop() {
    asio::post(acceptor_.get_executor(), [self = shared_from_this()] {
        Failure ignored;
        self->acceptor_.close(ignored);
        self->back_off_.cancel();
    });
}

void Listener::accept() {
    if (!acceptor_.is_open()) {
        return;
    }
    acceptor_.async_accept(
        asio::make_strand(io_), [self = shared_from_this()](Failure failure, tcp::socket socket) {
            if (!guarded("accept", [&] { self->onAccepted(failure, std::move(socket)); })) {
                self->accept();
            }
        });
}

void Listener::onAccepted(Failure failure, tcp::socket socket) {
    if (failure == asio::error::operation_aborted) {
        return;
    }
    if (outOfResources(failure)) {
        spdlog::warn("event=accepting_pauses port={} reason={}", port_,
                     logValue(failure.message()));
        back_off_.expires_after(kBackOff);
        back_off_.async_wait([self = shared_from_this()](Failure) { self->accept(); });
        return;
    }
    Failure gone; // it has no address then, and its first read fails
    const asio::ip::address peer = socket.remote_endpoint(gone).address();
    const TimePoint now = Clock::now();
    ConnectionTicket ticket =
        failure ? nullptr : tickets_.take(peer, site_->connectionsMax(peer), now);
    if (ticket) {
        serve(std::move(socket), site_, std::move(ticket));
    } else if (!failure) {
        spdlog::warn("event=connection_refused port={} peer={} limit={}", port_, peer.to_string(),
                     connections_max_);
        site_->onConnectionRefused();
        if (auto told = refused_tickets_.take(peer, kRefusedMax, now)) {
            serve(std::move(socket), busy_site_, std::move(told));
        } // else the socket closes here: a refusal would take what is short
    }
    accept();
}

void Listener::serve(tcp::socket socket,
                     std::shared_ptr<const HttpSite> site,
                     ConnectionTicket ticket) {
    tune(socket);
    const auto tls = tls_ ? tls_->context() : nullptr; // OpenSSL keeps what a connection needs
    std::make_shared<HttpSession>(std::move(socket), tls.get(), std::move(site), std::move(ticket))
        ->start();
}

} // namespace froxel::net

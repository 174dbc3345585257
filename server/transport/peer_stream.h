// The bytes of one connection, with or without TLS, on either side; a WebSocket on it ends so that
// the other side hears why. Beast 1.81's own teardown reads at most 2 KiB before it closes (it
// takes the count of bytes read for 0); what is unread then makes the kernel reset the connection,
// and the close frame is lost on the way.
#pragma once

#include <boost/asio/compose.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <boost/beast/websocket/teardown.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

namespace froxel::transport {

// Tcp: a boost::beast::basic_stream, whose policy sees TLS's own bytes too.
template <class Tcp>
class PeerStream {
  public:
    using next_layer_type = Tcp;
    using executor_type = typename Tcp::executor_type;
    // How long, and how much, the other side may still send after the close frame.
    static constexpr std::chrono::seconds kLinger{2};
    static constexpr size_t kMaxBytes = size_t{16} * 1024 * 1024;

    // Without `tls` bytes go as they are. `tls` lives on in the stream. `from`: what Tcp is made
    // of.
    template <class From>
    PeerStream(From&& from, boost::asio::ssl::context* tls) {
        if (tls != nullptr) {
            tls_.emplace(Tcp(std::forward<From>(from)), *tls);
        } else {
            plain_.emplace(std::forward<From>(from));
        }
    }

    // Deadlines, cancelling and closing are those of the TCP stream.
    [[nodiscard]] next_layer_type& next_layer() { return tls_ ? tls_->next_layer() : *plain_; }
    [[nodiscard]] const next_layer_type& next_layer() const {
        return tls_ ? tls_->next_layer() : *plain_;
    }
    [[nodiscard]] executor_type get_executor() { return next_layer().get_executor(); }
    [[nodiscard]] bool encrypted() const { return tls_.has_value(); }

    // With TLS, before anything else. `handler`: void(error_code).
    template <class Handler>
    void async_handshake(boost::asio::ssl::stream_base::handshake_type side, Handler&& handler) {
        tls_->async_handshake(side, std::forward<Handler>(handler));
    }
    // With TLS.
    [[nodiscard]] SSL* tls() { return tls_->native_handle(); }
    // Says that nothing more will be sent, and waits for the other side to say so.
    template <class Handler>
    void async_shutdown(Handler&& handler) {
        tls_->async_shutdown(std::forward<Handler>(handler));
    }
    template <class Buffers, class Handler>
    void async_read_some(const Buffers& buffers, Handler&& handler) {
        if (tls_) {
            tls_->async_read_some(buffers, std::forward<Handler>(handler));
        } else {
            plain_->async_read_some(buffers, std::forward<Handler>(handler));
        }
    }
    template <class Buffers, class Handler>
    void async_write_some(const Buffers& buffers, Handler&& handler) {
        if (tls_) {
            tls_->async_write_some(buffers, std::forward<Handler>(handler));
        } else {
            plain_->async_write_some(buffers, std::forward<Handler>(handler));
        }
    }

  private:
    // One of them.
    std::optional<next_layer_type> plain_;
    std::optional<boost::beast::ssl_stream<next_layer_type>> tls_;
};

namespace detail {

// Reads until the other side closes, too. With TLS what comes then is not looked at.
template <class Tcp>
struct Drain {
    PeerStream<Tcp>& stream;
    bool shut = false;
    std::unique_ptr<std::array<std::byte, 4096>> scratch =
        std::make_unique<std::array<std::byte, 4096>>();
    size_t read_bytes = 0;

    template <class Self>
    void operator()(Self& self) {
        if (stream.encrypted()) {
            stream.async_shutdown(std::move(self));
        } else {
            (*this)(self, {});
        }
    }
    template <class Self>
    void operator()(Self& self, boost::beast::error_code error, size_t bytes = 0) {
        Tcp& tcp = stream.next_layer();
        if (!shut) { // whether TLS ended well matters no more
            shut = true;
            error = {};
            boost::beast::error_code ignored;
            tcp.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
        }
        read_bytes += bytes;
        if (error || read_bytes > PeerStream<Tcp>::kMaxBytes) {
            tcp.close();
            self.complete(error == boost::asio::error::eof ? boost::beast::error_code() : error);
            return;
        }
        auto& into = *scratch; // stays where it is when this moves into the read
        tcp.async_read_some(boost::asio::buffer(into), std::move(self));
    }
};

} // namespace detail

// Found by Beast through its argument.
template <class Tcp, class Handler>
void async_teardown(boost::beast::role_type /*role*/, PeerStream<Tcp>& stream, Handler&& handler) {
    stream.next_layer().expires_after(PeerStream<Tcp>::kLinger);
    boost::asio::async_compose<Handler, void(boost::beast::error_code)>(
        detail::Drain<Tcp>{stream}, handler, stream.next_layer());
}

} // namespace froxel::transport

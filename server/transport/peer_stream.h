// The bytes of one connection, with or without TLS, on either side; a WebSocket on it ends so that
// the other side hears why. Beast 1.81's own teardown reads at most 2 KiB before it closes (it
// takes the count of bytes read for 0); what is unread then makes the kernel reset the connection,
// and the close frame is lost on the way.
#pragma once

#include "transport/io_end.h"

#include <boost/asio/ssl/context.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>

#include <chrono>
#include <cstddef>
#include <optional>
#include <utility>

namespace froxel::transport {

// Tcp: a boost::beast::basic_stream, whose policy sees TLS's own bytes too. One source of each Tcp
// includes peer_stream_impl.h and makes the class. Handlers run on the stream's executor.
template <class Tcp>
class PeerStream {
  public:
    using next_layer_type = Tcp;
    using executor_type = typename Tcp::executor_type;
    // How long, and how much, the other side may still send after the close frame.
    static constexpr std::chrono::seconds kLinger{2};
    static constexpr size_t kMaxBytes = size_t{16} * 1024 * 1024;

    // Without `tls` bytes go as they are. `tls` lives on in the stream.
    PeerStream(Tcp tcp, boost::asio::ssl::context* tls);
    PeerStream(PeerStream&& other) noexcept;
    ~PeerStream();

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
        handshake(side, IoEnd(std::forward<Handler>(handler)));
    }
    // With TLS.
    [[nodiscard]] SSL* tls() { return tls_->native_handle(); }
    template <class Buffers, class Handler>
    void async_read_some(const Buffers& buffers, Handler&& handler) {
        readSome(IoBuffers<boost::asio::mutable_buffer>(buffers),
                 IoEnd(std::forward<Handler>(handler)));
    }
    template <class Buffers, class Handler>
    void async_write_some(const Buffers& buffers, Handler&& handler) {
        writeSome(IoBuffers<boost::asio::const_buffer>(buffers),
                  IoEnd(std::forward<Handler>(handler)));
    }
    // Says that nothing more will be sent, and reads until the other side closes, too. With TLS
    // what comes then is not looked at.
    void teardown(IoEnd end);

  private:
    void handshake(boost::asio::ssl::stream_base::handshake_type side, IoEnd end);
    void readSome(const IoBuffers<boost::asio::mutable_buffer>& buffers, IoEnd end);
    void writeSome(const IoBuffers<boost::asio::const_buffer>& buffers, IoEnd end);

    // One of them.
    std::optional<next_layer_type> plain_;
    std::optional<boost::beast::ssl_stream<next_layer_type>> tls_;
};

// Found by Beast through its argument.
template <class Tcp, class Handler>
void async_teardown(boost::beast::role_type /*role*/, PeerStream<Tcp>& stream, Handler&& handler) {
    stream.teardown(IoEnd(std::forward<Handler>(handler)));
}

} // namespace froxel::transport

// What the sources include that make a PeerStream of their Tcp.
#pragma once

#include "transport/peer_stream.h"

#include <array>
#include <memory>

namespace froxel::transport {

template <class Tcp>
PeerStream<Tcp>::PeerStream(Tcp tcp, boost::asio::ssl::context* tls) {
    if (tls != nullptr) {
        tls_.emplace(std::move(tcp), *tls);
    } else {
        plain_.emplace(std::move(tcp));
    }
}

template <class Tcp>
PeerStream<Tcp>::PeerStream(PeerStream&& other) noexcept = default;

template <class Tcp>
PeerStream<Tcp>::~PeerStream() = default;

template <class Tcp>
void PeerStream<Tcp>::handshake(boost::asio::ssl::stream_base::handshake_type side, IoEnd end) {
    tls_->async_handshake(side, std::move(end));
}

template <class Tcp>
void PeerStream<Tcp>::readSome(const IoBuffers<boost::asio::mutable_buffer>& buffers, IoEnd end) {
    if (tls_) {
        tls_->async_read_some(buffers, std::move(end));
    } else {
        plain_->async_read_some(buffers, std::move(end));
    }
}

template <class Tcp>
void PeerStream<Tcp>::writeSome(const IoBuffers<boost::asio::const_buffer>& buffers, IoEnd end) {
    if (tls_) {
        tls_->async_write_some(buffers, std::move(end));
    } else {
        plain_->async_write_some(buffers, std::move(end));
    }
}

namespace detail {

template <class Tcp>
struct Drain {
    Tcp& tcp;
    IoEnd end;
    std::unique_ptr<std::array<std::byte, 4096>> scratch =
        std::make_unique<std::array<std::byte, 4096>>();
    size_t read_bytes = 0;

    // Whether TLS ended well matters not.
    void shut() {
        boost::beast::error_code ignored;
        tcp.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
        read();
    }
    void read() {
        auto& into = *scratch; // stays where it is when this moves into the read
        tcp.async_read_some(boost::asio::buffer(into), std::move(*this));
    }
    void operator()(boost::beast::error_code error, size_t bytes) {
        read_bytes += bytes;
        if (error || read_bytes > PeerStream<Tcp>::kMaxBytes) {
            tcp.close();
            end(error == boost::asio::error::eof ? boost::beast::error_code() : error);
            return;
        }
        read();
    }
};

} // namespace detail

template <class Tcp>
void PeerStream<Tcp>::teardown(IoEnd end) {
    Tcp& tcp = next_layer();
    tcp.expires_after(kLinger);
    detail::Drain<Tcp> drain{tcp, std::move(end)};
    if (tls_) {
        tls_->async_shutdown(
            [drain = std::move(drain)](boost::beast::error_code) mutable { drain.shut(); });
    } else {
        drain.shut();
    }
}

} // namespace froxel::transport

// A TCP stream whose WebSocket ends so that the other side hears why. Beast 1.81's own teardown
// reads at most 2 KiB before it closes (it takes the count of bytes read for 0); what is unread
// then makes the kernel reset the connection, and the close frame is lost on the way.
#pragma once

#include <boost/asio/compose.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket/teardown.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <memory>
#include <utility>

namespace froxel::net {

class LingeringStream : public boost::beast::tcp_stream {
  public:
    // How long, and how much, the other side may still send after the close frame.
    static constexpr std::chrono::seconds kLinger{2};
    static constexpr size_t kMaxBytes = size_t{16} * 1024 * 1024;

    explicit LingeringStream(boost::beast::tcp_stream stream)
        : boost::beast::tcp_stream(std::move(stream)) {}
};

namespace detail {

// Reads until the other side closes, too.
struct Drain {
    LingeringStream& stream;
    std::unique_ptr<std::array<std::byte, 4096>> scratch =
        std::make_unique<std::array<std::byte, 4096>>();
    size_t read_bytes = 0;

    template <class Self>
    void operator()(Self& self, boost::beast::error_code error = {}, size_t bytes = 0) {
        read_bytes += bytes;
        if (error || read_bytes > LingeringStream::kMaxBytes) {
            stream.close();
            self.complete(error == boost::asio::error::eof ? boost::beast::error_code() : error);
            return;
        }
        auto& into = *scratch; // stays where it is when this moves into the read
        stream.async_read_some(boost::asio::buffer(into), std::move(self));
    }
};

} // namespace detail

// Found by Beast through its argument.
template <class Handler>
void async_teardown(boost::beast::role_type /*role*/, LingeringStream& stream, Handler&& handler) {
    boost::beast::error_code ignored;
    stream.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
    stream.expires_after(LingeringStream::kLinger);
    boost::asio::async_compose<Handler, void(boost::beast::error_code)>(detail::Drain{stream},
                                                                        handler, stream);
}

} // namespace froxel::net

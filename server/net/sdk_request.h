// One request to an HTTP interface of this host, and its answer's status.
#pragma once

#include "core/error.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace froxel::net {

class SdkRequest : public std::enable_shared_from_this<SdkRequest> {
  public:
    // The status, or kIo: nobody there, no answer in time, no HTTP.
    using Done = std::function<void(Result<unsigned>)>;

    SdkRequest(boost::asio::io_context& io,
               uint16_t port,
               std::string_view method,
               std::string_view path,
               std::string body);
    // `done` is called once, on a thread of `io`.
    void start(std::chrono::milliseconds timeout, Done done);
    // It fails at once.
    void cancel() { stream_.close(); }

  private:
    void onStep(boost::beast::error_code error, void (SdkRequest::*next)());
    void write();
    void read();
    void finish();

    std::array<boost::asio::ip::tcp::endpoint, 2> endpoints_; // "localhost"
    boost::beast::tcp_stream stream_;
    boost::beast::http::request<boost::beast::http::string_body> request_;
    boost::beast::http::response_parser<boost::beast::http::string_body> parser_;
    boost::beast::flat_buffer buffer_;
    Done done_;
};

} // namespace froxel::net

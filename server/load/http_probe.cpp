#include "load/http_probe.h"

#include "core/text.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>

namespace froxel::load {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;

constexpr uint64_t kMaxBodyBytes = 1 << 20;

} // namespace

Result<ProbeAnswer>
probe(const Target& target, std::chrono::milliseconds timeout, const std::string& token) {
    boost::asio::io_context io;
    boost::asio::ip::tcp::resolver resolver(io);
    beast::tcp_stream stream(io);
    http::request<http::empty_body> request(http::verb::get, target.resource, 11);
    request.set(http::field::host, target.authority);
    request.keep_alive(false);
    if (!token.empty()) {
        request.set(http::field::authorization, "Bearer " + token);
    }
    http::response_parser<http::string_body> parser;
    parser.body_limit(kMaxBodyBytes);
    beast::flat_buffer buffer;
    beast::error_code failure;

    stream.expires_after(timeout);
    const auto endpoints = resolver.resolve(target.host, target.port, failure);
    if (!failure) {
        stream.async_connect(endpoints, [&](beast::error_code error, const auto&) {
            failure = error;
            if (error) {
                return;
            }
            http::async_write(stream, request, [&](beast::error_code sent, size_t) {
                failure = sent;
                if (!sent) {
                    http::async_read(stream, buffer, parser,
                                     [&](beast::error_code read, size_t) { failure = read; });
                }
            });
        });
        io.run();
    }
    if (failure) {
        return Error{ErrorCode::kIo, printable(target.authority, 200) + ": " + failure.message()};
    }
    const std::string& body = parser.get().body();
    return ProbeAnswer{parser.get().result_int(), printable(body.substr(0, body.find('\n')), 400),
                       body};
}

} // namespace froxel::load

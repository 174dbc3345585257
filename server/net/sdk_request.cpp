#include "net/sdk_request.h"

#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>

#include <utility>

namespace froxel::net {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

namespace {

constexpr uint64_t kMaxBodyBytes = 64 * 1024;

beast::string_view viewOf(std::string_view text) {
    return {text.data(), text.size()};
}

} // namespace

SdkRequest::SdkRequest(asio::io_context& io,
                       uint16_t port,
                       std::string_view method,
                       std::string_view path,
                       std::string body)
    : endpoints_{asio::ip::tcp::endpoint(asio::ip::address_v4::loopback(), port),
                 asio::ip::tcp::endpoint(asio::ip::address_v6::loopback(), port)},
      stream_(io), request_(http::string_to_verb(viewOf(method)), viewOf(path), 11) {
    request_.set(http::field::host, "localhost:" + std::to_string(port));
    request_.set(http::field::content_type, "application/json");
    request_.keep_alive(false);
    request_.body() = std::move(body);
    request_.prepare_payload();
    parser_.body_limit(kMaxBodyBytes);
}

void SdkRequest::start(std::chrono::milliseconds timeout, Done done) {
    done_ = std::move(done);
    stream_.expires_after(timeout);
    stream_.async_connect(endpoints_,
                          [self = shared_from_this()](beast::error_code error, const auto&) {
                              self->onStep(error, &SdkRequest::write);
                          });
}

void SdkRequest::onStep(beast::error_code error, void (SdkRequest::*next)()) {
    if (error) {
        std::exchange(done_, {})(Error{ErrorCode::kIo, error.message()});
    } else {
        (this->*next)();
    }
}

void SdkRequest::write() {
    http::async_write(stream_, request_,
                      [self = shared_from_this()](beast::error_code error, size_t) {
                          self->onStep(error, &SdkRequest::read);
                      });
}

void SdkRequest::read() {
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](beast::error_code error, size_t) {
                         self->onStep(error, &SdkRequest::finish);
                     });
}

void SdkRequest::finish() {
    std::exchange(done_, {})(parser_.get().result_int());
}

} // namespace froxel::net

#include "integration/sdk_mock.h"

#include "integration/eventually.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <mutex>
#include <thread>

namespace froxel::test {

namespace asio = boost::asio;
namespace http = boost::beast::http;
using asio::ip::tcp;

namespace {

const tcp::endpoint kAnyPort(asio::ip::address_v4::loopback(), 0);

std::string textOf(boost::beast::string_view text) {
    return {text.data(), text.size()};
}

struct Connection {
    explicit Connection(tcp::socket socket) : stream(std::move(socket)) {}
    boost::beast::tcp_stream stream;
    boost::beast::flat_buffer buffer;
    http::request<http::string_body> request;
    http::response<http::string_body> response;
};

} // namespace

struct SdkMock::Impl {
    Impl(Answer how, uint16_t port)
        : answer(how), acceptor(io, {asio::ip::address_v4::loopback(), port}) {
        accept();
        thread = std::jthread([this] { io.run(); });
    }
    ~Impl() { io.stop(); }

    void accept() {
        acceptor.async_accept([this](boost::system::error_code error, tcp::socket socket) {
            if (!error) {
                serve(std::make_shared<Connection>(std::move(socket)));
                accept();
            }
        });
    }

    void serve(const std::shared_ptr<Connection>& connection) {
        http::async_read(connection->stream, connection->buffer, connection->request,
                         [this, connection](boost::system::error_code error, size_t) {
                             if (!error) {
                                 reply(connection);
                             }
                         });
    }

    void reply(const std::shared_ptr<Connection>& connection) {
        const std::lock_guard lock(mutex);
        if (answer == Answer::kHangs) {
            hanging.push_back(connection);
            return;
        }
        const bool accepts = answer == Answer::kAccepts;
        if (accepts) {
            keep(connection->request);
        }
        auto& response = connection->response;
        response.result(accepts ? http::status::ok : http::status::internal_server_error);
        response.set(http::field::content_type, "application/json");
        response.body() = "{}";
        response.keep_alive(false);
        response.prepare_payload();
        http::async_write(connection->stream, response,
                          [connection](boost::system::error_code, size_t) {});
    }

    void keep(const http::request<http::string_body>& request) {
        if (request.target() == "/health") {
            ++health_count;
            return;
        }
        const auto body = nlohmann::json::parse(request.body());
        if (request.method() == http::verb::patch) {
            counter =
                body.at("count").get<std::string>() + "/" + body.at("capacity").get<std::string>();
        }
        calls.push_back(textOf(request.method_string()) + " " + textOf(request.target()));
    }

    std::mutex mutex;
    Answer answer;
    std::vector<std::string> calls;
    size_t health_count = 0;
    std::string counter;
    asio::io_context io{1};
    std::vector<std::shared_ptr<Connection>> hanging;
    tcp::acceptor acceptor;
    std::jthread thread;
};

SdkMock::SdkMock(Answer answer, uint16_t port) : impl_(std::make_unique<Impl>(answer, port)) {}

SdkMock::~SdkMock() = default;

uint16_t SdkMock::freePort() {
    asio::io_context io;
    return tcp::acceptor(io, kAnyPort).local_endpoint().port();
}

uint16_t SdkMock::port() const {
    return impl_->acceptor.local_endpoint().port();
}

void SdkMock::answer(Answer answer) {
    const std::lock_guard lock(impl_->mutex);
    impl_->answer = answer;
}

std::vector<std::string> SdkMock::calls() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->calls;
}

size_t SdkMock::healthCount() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->health_count;
}

std::string SdkMock::counter() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->counter;
}

bool SdkMock::comesToState(const std::string& call) const {
    return eventually([&] {
        const auto all = calls();
        const auto last = std::find_if(all.rbegin(), all.rend(),
                                       [](const auto& one) { return one.starts_with("POST"); });
        return last != all.rend() && *last == call;
    });
}

bool SdkMock::comesToCounter(const std::string& value) const {
    return eventually([&] { return counter() == value; });
}

} // namespace froxel::test

#include "net/http_session.h"

#include "core/text.h"
#include "net/facts.h"
#include "net/guard.h"
#include "net/request_form.h"

#include <boost/asio/dispatch.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/string.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <spdlog/fmt/chrono.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>

namespace froxel::net {

namespace beast = boost::beast;
namespace http = beast::http;

namespace {

// How long, and how much, a connection may still send after its last answer.
constexpr std::chrono::seconds kLinger{2};
constexpr size_t kMaxDiscardedBytes = size_t{256} * 1024;
constexpr size_t kFirstBytes = 512; // what each waiting connection has room for

// RFC 9110, 5.6.7.
std::string dateOf(std::chrono::system_clock::time_point now) {
    return fmt::format("{:%a, %d %b %Y %H:%M:%S GMT}",
                       fmt::gmtime(std::chrono::system_clock::to_time_t(now)));
}

// Of one whose taker threw.
Response bodyFailed() {
    return refusal(http::status::internal_server_error, "the server could not take the body");
}

} // namespace

HttpSession::HttpSession(boost::asio::ip::tcp::socket socket,
                         boost::asio::ssl::context* tls,
                         std::shared_ptr<const HttpSite> site,
                         ConnectionTicket ticket)
    : strand_(socket.get_executor()), stream_(PacedTcp(std::move(socket)), tls),
      request_deadline_(strand_), site_(std::move(site)), ticket_(std::move(ticket)) {}

void HttpSession::start() {
    boost::asio::dispatch(strand_, [self = shared_from_this()] {
        if (!guarded("http start", [&] {
                if (Service* service = self->site_->drainsWith()) {
                    service->subscribe(self);
                }
                if (self->stream_.encrypted()) {
                    self->shakeHands();
                } else {
                    self->read();
                }
            })) {
            self->close();
        }
    });
}

void HttpSession::shakeHands() {
    giveWayWhileWaiting();
    stream_.next_layer().expires_after(kDeadline);
    stream_.async_handshake(boost::asio::ssl::stream_base::server, [self = shared_from_this()](
                                                                       beast::error_code error) {
        if (error) {
            spdlog::info("event=tls_handshake_failed reason={}", logValue(error.message()));
        }
        if (error || !guarded("http start", [&] { self->read(); })) {
            self->close();
        }
    });
}

void HttpSession::onServiceChanged() {
    boost::asio::dispatch(strand_, [self = shared_from_this()] {
        const bool waiting = self->reading_ && !self->parser_->got_some();
        if (waiting && self->draining()) {
            self->close();
        }
    });
}

bool HttpSession::draining() const {
    const Service* service = site_->drainsWith();
    return service && service->status().draining.has_value();
}

void HttpSession::giveWayWhileWaiting() {
    ticket_->waitForClient(closeLater(), Clock::now());
}

std::function<void()> HttpSession::closeLater() {
    // Under the caller's lock nothing is held that may be the connection's last holder.
    return [strand = strand_, weak = weak_from_this()] {
        boost::asio::post(strand, [weak] {
            if (const auto self = weak.lock()) {
                self->close();
            }
        });
    };
}

void HttpSession::read() {
    giveWayWhileWaiting();
    parser_.emplace();
    parser_->header_limit(kMaxHeaderBytes);
    parser_->body_limit(boost::none);
    reading_ = true;
    late_ = false;
    // One deadline for the whole request, however slowly its bytes trickle in. Not the stream's
    // own timeout: that closes the socket, and 408 could not be said.
    stream_.next_layer().expires_never();
    request_deadline_.expires_after(kDeadline);
    request_deadline_.async_wait([self = shared_from_this()](beast::error_code error) {
        const bool due = self->request_deadline_.expiry() <= std::chrono::steady_clock::now();
        if (!error && due && self->reading_) {
            self->late_ = true;
            self->stream_.next_layer().cancel();
        }
    });
    readHeader();
}

// Empty lines before a request are no part of it (RFC 9112, 2.2); Beast does not skip them.
void HttpSession::readHeader() {
    const auto bytes = static_cast<const char*>(buffer_.data().data());
    const std::string_view ahead(bytes, buffer_.size());
    buffer_.consume(std::min(ahead.find_first_not_of("\r\n"), ahead.size()));
    const auto then = [self = shared_from_this()](auto next) {
        return [self, next](beast::error_code error, size_t size) {
            if (!guarded("http read", [&] { next(*self, error, size); })) {
                self->close();
            }
        };
    };
    if (buffer_.size() > 0) {
        http::async_read_header(
            stream_, buffer_, *parser_,
            then([](HttpSession& self, beast::error_code error, size_t) { self.onRead(error); }));
        return;
    }
    stream_.async_read_some(buffer_.prepare(kFirstBytes),
                            then([](HttpSession& self, beast::error_code error, size_t size) {
                                self.buffer_.commit(size);
                                if (error) {
                                    self.onRead(error);
                                } else {
                                    self.readHeader();
                                }
                            }));
}

void HttpSession::onRead(beast::error_code error) {
    reading_ = false;
    request_deadline_.cancel();
    if (error) {
        onReadError(error);
    } else {
        onRequest();
    }
}

void HttpSession::onReadError(beast::error_code error) {
    if (error == http::error::header_limit || error == http::error::buffer_overflow) {
        write(refusal(http::status::request_header_fields_too_large,
                      "the request's header has more than " + numberText(kMaxHeaderBytes) +
                          " bytes"));
    } else if (late_ && parser_->got_some()) {
        write(refusal(http::status::request_timeout,
                      "no complete request within " + numberText(kDeadline.count()) + " s"));
    } else if (error.category() == beast::error_code(http::error::bad_method).category() &&
               error != http::error::end_of_stream && error != http::error::partial_message) {
        write(refusal(http::status::bad_request, "not an HTTP request: " + error.message()));
    } else {
        close();
    }
}

void HttpSession::onRequest() {
    const bool receives = site_->takesBody(parser_->get().method(), pathOf(parser_->get()));
    if (!receives && !parser_->is_done()) { // the header is complete and something is to follow
        write(refusal(http::status::payload_too_large, "requests must not have a body"));
        return;
    }
    ticket_->heardClient();
    Request request = receives ? parser_->get() : parser_->release();
    if (auto refused = refuse(request)) {
        write(std::move(*refused));
        return;
    }
    const auto peer = peerAddress(stream_);
    if (const Seconds wait = site_->waitOf(request, peer); wait.count() > 0) {
        refuseLater(wait);
        return;
    }
    if (receives) {
        receive(std::move(request));
        return;
    }
    parser_.reset();
    if (beast::websocket::is_upgrade(request)) {
        upgrade(std::move(request));
        return;
    }
    if (answersLater(request)) {
        return;
    }
    const bool asks = request.method() == http::verb::get && isSocketPath(pathOf(request));
    auto refused = asks ? site_->refuseUpgrade(request, peer) : std::nullopt;
    write(refused ? std::move(*refused) : respond(request, *site_, peer));
}

std::optional<Response> HttpSession::refuse(Request& request) const {
    if (const auto settled = settleForm(request); !settled) {
        return refusal(settled.error().code == ErrorCode::kUnsupported
                           ? http::status::not_implemented
                           : http::status::bad_request,
                       settled.error().message);
    }
    return refuseHost(request, *site_);
}

void HttpSession::receive(Request request) {
    const uint64_t size_bytes = parser_->content_length().value_or(0);
    auto received = site_->receive(request, pathOf(request), peerAddress(stream_), size_bytes);
    receiving_ = std::make_shared<Receiving>(std::move(*parser_), std::move(request));
    parser_.reset();
    if (auto* refused = std::get_if<Response>(&received)) {
        refuseBody(std::move(*refused));
        return;
    }
    receiving_->body = std::move(std::get<std::unique_ptr<RequestBody>>(received));
    receiving_->due = std::chrono::steady_clock::now() + kDeadline +
                      std::chrono::seconds(size_bytes / kSlowestBodyBytes_s);
    stream_.next_layer().rate_policy().beginBody();
    buffer_.reserve(receiving_->part.size()); // so much is read at once
    const auto expects = receiving_->request[http::field::expect];
    if (receiving_->parser.is_done()) { // it is empty
        completeBody();
    } else if (beast::iequals(expects, "100-continue")) { // RFC 9110, 10.1.1
        tellToContinue();
    } else if (!expects.empty()) {
        refuseBody(refusal(http::status::expectation_failed,
                           "the only expectation that is met is 100-continue"));
    } else {
        receiveMore();
    }
}

void HttpSession::tellToContinue() {
    static constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
    stream_.next_layer().expires_after(kDeadline);
    boost::asio::async_write(stream_, boost::asio::buffer(kContinue),
                             [self = shared_from_this()](beast::error_code error, size_t) {
                                 if (error || !guarded("http read", [&] {
                                         self->stream_.next_layer().expires_never();
                                         self->receiveMore();
                                     })) {
                                     self->close();
                                 }
                             });
}

void HttpSession::receiveMore() {
    if (!receiving_) { // closed meanwhile
        return;
    }
    giveWayWhileWaiting();
    request_deadline_.expires_at(
        std::min(receiving_->due, std::chrono::steady_clock::now() + kLongestPause));
    request_deadline_.async_wait([self = shared_from_this()](beast::error_code error) {
        if (!error && self->receiving_ &&
            self->request_deadline_.expiry() <= std::chrono::steady_clock::now()) {
            self->late_ = true;
            self->stream_.next_layer().cancel();
        }
    });
    auto& into = receiving_->parser.get().body();
    into.data = receiving_->part.data();
    into.size = receiving_->part.size();
    http::async_read_some(
        stream_, buffer_, receiving_->parser,
        [self = shared_from_this(), held = receiving_](beast::error_code error, size_t) {
            if (!guarded("http read", [&] { self->onPart(error); })) {
                self->close();
            }
        });
}

void HttpSession::onPart(beast::error_code error) {
    if (!receiving_) { // closed meanwhile
        return;
    }
    request_deadline_.cancel();
    ticket_->heardClient();
    if (error && error != http::error::need_buffer) {
        if (late_) {
            refuseBody(
                refusal(http::status::request_timeout,
                        "the body came with less than " + numberText(kSlowestBodyBytes_s / 1024) +
                            " KiB/s or paused for " + numberText(kLongestPause.count()) + " s"));
        } else {
            close();
        }
        return;
    }
    const size_t came = receiving_->part.size() - receiving_->parser.get().body().size;
    const auto take = [held = receiving_, came] {
        std::optional<Response> refused;
        const auto bytes = std::span(held->part).first(came);
        return guarded("http body", [&] { refused = held->body->take(bytes); })
                   ? std::move(refused)
                   : std::optional(bodyFailed());
    };
    if (!receiving_->body->waits()) {
        onTaken(take());
        return;
    }
    site_->longWork()->run(
        strand_, take, [self = shared_from_this()](std::optional<Response> refused, Seconds) {
            if (!guarded("http read", [&] { self->onTaken(std::move(refused)); })) {
                self->close();
            }
        });
}

void HttpSession::onTaken(std::optional<Response> refused) {
    if (!receiving_) { // closed meanwhile
        return;
    }
    if (refused) {
        refuseBody(std::move(*refused));
    } else if (receiving_->parser.is_done()) {
        completeBody();
    } else {
        receiveMore();
    }
}

void HttpSession::completeBody() {
    endBody();
    const auto received = std::move(receiving_);
    answerLaterBy(received->request, [&](auto done) -> std::optional<HttpSite::CallOff> {
        if (!received->body->waits()) {
            return received->body->complete(std::move(done));
        }
        site_->longWork()->post([received, done = std::move(done)] {
            if (!guarded("http body", [&] { received->body->complete(done); })) {
                done({bodyFailed()});
            }
        });
        return [] {};
    });
}

void HttpSession::endBody() {
    stream_.next_layer().rate_policy().endBody();
    buffer_.shrink_to_fit();
}

void HttpSession::refuseBody(Response response) {
    response.keep_alive(receiving_->parser.is_done() && receiving_->request.keep_alive());
    LateAnswer answer = finished(receiving_->request, {std::move(response)});
    receiving_.reset();
    endBody();
    write(std::move(answer));
}

// A refusal that came at once would be asked for again at once, and each costs as much as an
// answer.
void HttpSession::refuseLater(Seconds wait) {
    giveWayWhileWaiting();
    constexpr Seconds kLeast{1};
    constexpr Seconds kMost{5};
    const Seconds pause = std::clamp(wait, kLeast, kMost);
    request_deadline_.expires_after(std::chrono::ceil<std::chrono::milliseconds>(pause));
    request_deadline_.async_wait([self = shared_from_this()](beast::error_code error) {
        if (!error && !guarded("http answer", [&] {
                Response response =
                    refusal(http::status::too_many_requests,
                            "too many requests from this address or token; try again later");
                response.set(http::field::retry_after, "5");
                self->write(std::move(response));
            })) {
            self->close();
        }
    });
}

bool HttpSession::answersLater(const Request& request) {
    if (!isOneOf(request, site_->methodsOf(pathOf(request)))) {
        return false;
    }
    answerLaterBy(request, [&](auto done) {
        return site_->answerLater(request, pathOf(request), peerAddress(stream_), std::move(done));
    });
    return call_off_.has_value();
}

template <class Ask>
void HttpSession::answerLaterBy(const Request& request, const Ask& ask) {
    const uint64_t question = ++question_;
    call_off_ = ask([self = shared_from_this(), question, request](LateAnswer answer) {
        boost::asio::post(
            self->strand_, [self, question, request, answer = std::move(answer)]() mutable {
                if (self->question_ == question && std::exchange(self->call_off_, std::nullopt) &&
                    !guarded("http answer",
                             [&] { self->write(finished(request, std::move(answer))); })) {
                    self->close();
                }
            });
    });
    if (call_off_) {
        watchForEnd(question);
    }
}

// Nothing is drawn for who has gone. What a client sends ahead waits.
void HttpSession::watchForEnd(uint64_t question) {
    stream_.next_layer().socket().async_wait(
        boost::asio::socket_base::wait_read,
        [self = shared_from_this(), question](beast::error_code error) {
            beast::error_code gone;
            const bool waits = self->question_ == question && self->call_off_;
            if (waits && (error || self->stream_.next_layer().socket().available(gone) == 0)) {
                self->close();
            }
        });
}

void HttpSession::upgrade(Request request) {
    if (auto refused = site_->refuseUpgrade(request, peerAddress(stream_))) {
        write(std::move(*refused));
    } else if (buffer_.size() > 0) {
        write(refusal(http::status::bad_request, "bytes before the answer to the upgrade"));
    } else {
        stream_.next_layer().expires_never();
        site_->upgrade(std::move(stream_), std::move(request), std::move(ticket_));
    }
}

void HttpSession::write(LateAnswer answer) {
    answer_ = std::move(answer);
    Response& response = answer_.response;
    response.set(http::field::date, dateOf(std::chrono::system_clock::now()));
    if (stream_.encrypted()) { // a browser that has seen this asks for http here no more; RFC 6797
        response.set("Strict-Transport-Security", "max-age=31536000");
    }
    if (!answer_.picture) {
        stream_.next_layer().expires_after(kDeadline);
        send(response);
        return;
    }
    if (answer_.sending) {
        answer_.sending(closeLater());
    }
    const std::vector<std::byte>& bytes = *answer_.picture;
    stream_.next_layer().expires_after(kDeadline +
                                       std::chrono::seconds(bytes.size() / kSlowestBytes_s));
    picture_.base() = std::move(response.base());
    picture_.body() = {bytes.data(), bytes.size()};
    send(picture_);
}

template <class Message>
void HttpSession::send(Message& message) {
    http::async_write(
        stream_, message,
        [self = shared_from_this(), last = message.need_eof()](beast::error_code error, size_t) {
            self->answer_ = {}; // and whatever counts by it
            if (!guarded("http write", [&] { self->onWritten(error, last); })) {
                self->close();
            }
        });
}

void HttpSession::onWritten(beast::error_code error, bool last) {
    if (error) {
        close();
    } else if (last || draining()) {
        beast::error_code ignored;
        stream_.next_layer().socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send,
                                               ignored);
        stream_.next_layer().expires_after(kLinger);
        linger();
    } else {
        read();
    }
}

// Closing with bytes unread would reset the connection, and the answer might never be seen.
void HttpSession::linger() {
    stream_.async_read_some(boost::asio::buffer(discarded_),
                            [self = shared_from_this()](beast::error_code error, size_t bytes) {
                                self->discarded_bytes_ += bytes;
                                if (error || self->discarded_bytes_ > kMaxDiscardedBytes) {
                                    self->close();
                                } else {
                                    self->linger();
                                }
                            });
}

void HttpSession::close() {
    reading_ = false;
    receiving_.reset();
    request_deadline_.cancel();
    if (const auto call_off = std::exchange(call_off_, std::nullopt)) {
        (*call_off)();
    }
    stream_.next_layer().close();
}

} // namespace froxel::net

// One TCP connection while it speaks HTTP: answers requests until it closes or becomes a
// WebSocket. One strand.
#pragma once

#include "net/http_site.h"

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/buffer_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/span_body.hpp>

#include <array>
#include <functional>
#include <memory>
#include <optional>

namespace froxel::net {

class HttpSession final : public ServiceListener, public std::enable_shared_from_this<HttpSession> {
  public:
    static constexpr uint32_t kMaxHeaderBytes = 8 * 1024;
    // For one whole request, and for one whole response ...
    static constexpr std::chrono::seconds kDeadline{10};
    // ... with a second more for so many bytes of a picture: 4 Mbit/s.
    static constexpr size_t kSlowestBytes_s = 512 * 1024;
    // A body comes with at least so many bytes a second, and without a longer pause.
    static constexpr size_t kSlowestBodyBytes_s = 64 * 1024;
    static constexpr std::chrono::seconds kLongestPause{10};

    // `tls` may be null: without encryption.
    HttpSession(boost::asio::ip::tcp::socket socket,
                boost::asio::ssl::context* tls,
                std::shared_ptr<const HttpSite> site,
                ConnectionTicket ticket);
    void start();
    // Ends a connection that is between requests when the server drains.
    void onServiceChanged() override;

  private:
    // Bytes of others' that are sent as they are.
    using Picture = boost::beast::http::response<boost::beast::http::span_body<const std::byte>>;
    using Parser = boost::beast::http::request_parser<boost::beast::http::empty_body>;

    using BodyParser = boost::beast::http::request_parser<boost::beast::http::buffer_body>;
    // Of a request whose body comes.
    struct Receiving {
        Receiving(Parser&& header, Request its_request)
            : parser(std::move(header)), request(std::move(its_request)) {}

        BodyParser parser;
        const Request request;
        std::unique_ptr<RequestBody> body;
        std::chrono::steady_clock::time_point due; // all of it
        std::array<std::byte, size_t{64} * 1024> part{};
    };

    [[nodiscard]] bool draining() const;
    void shakeHands();
    void read();
    void readHeader();
    void onRead(boost::beast::error_code error);
    void onReadError(boost::beast::error_code error);
    void onRequest();
    // Why a request of this form or this sender is answered no further.
    [[nodiscard]] std::optional<Response> refuse(Request& request) const;
    void receive(Request request);
    void tellToContinue();
    void receiveMore();
    void onPart(boost::beast::error_code error);
    void onTaken(std::optional<Response> refused);
    void completeBody();
    // No more of one is read.
    void endBody();
    // Ends the body before it has come to its end.
    void refuseBody(Response response);
    // Tells, after a while, that there were too many requests.
    void refuseLater(Seconds wait);
    // The client is waited for: the connection may have to go for another.
    void giveWayWhileWaiting();
    // Closes the connection, if it is still there; on any thread.
    [[nodiscard]] std::function<void()> closeLater();
    void upgrade(Request request);
    // Whether the answer comes later.
    [[nodiscard]] bool answersLater(const Request& request);
    // Has the answer to this request come later from `ask`, which calls it off; none: it does not.
    template <class Ask>
    void answerLaterBy(const Request& request, const Ask& ask);
    void watchForEnd(uint64_t question);
    void write(Response response) { write(LateAnswer{std::move(response)}); }
    void write(LateAnswer answer);
    template <class Message>
    void send(Message& message);
    // `last`: no other answer follows on this connection.
    void onWritten(boost::beast::error_code error, bool last);
    void linger();
    void close();

    const PeerStream::executor_type strand_; // the stream's own, which goes away with an upgrade
    PeerStream stream_;
    boost::asio::steady_timer request_deadline_;
    bool reading_ = false;
    bool late_ = false;
    const std::shared_ptr<const HttpSite> site_;
    ConnectionTicket ticket_;
    boost::beast::flat_buffer buffer_;
    std::optional<Parser> parser_;
    std::shared_ptr<Receiving> receiving_; // null: no body comes; a read holds it, too
    LateAnswer answer_;                    // on its way
    Picture picture_;                      // where that is one
    uint64_t question_ = 0;                // of those answered later
    std::optional<HttpSite::CallOff> call_off_;
    std::array<std::byte, 4096> discarded_{};
    size_t discarded_bytes_ = 0;
};

} // namespace froxel::net

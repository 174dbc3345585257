#include "net/ws_connection.h"

#include "core/text.h"
#include "net/facts.h"
#include "net/guard.h"
#include "protocol/limits.h"

#include <boost/asio/post.hpp>
#include <boost/beast/websocket/rfc6455.hpp>

#include <array>
#include <utility>

namespace froxel::net {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;

namespace {

constexpr std::chrono::seconds kHandshakeTimeout{10};
// Beast's idle timer is re-armed by reads alone, so a client that sends but never reads would pin
// a write for ever. The allowance lets a large picture through a link of 0.5 Mbit/s.
constexpr std::chrono::seconds kWriteTimeout{5};
constexpr std::chrono::seconds kCloseTimeout{4};
constexpr size_t kSlowestBytesPerSecond = size_t{64} * 1024;

std::string peerName(const PeerStream& stream) {
    beast::error_code error;
    const auto endpoint = stream.next_layer().socket().remote_endpoint(error);
    return error ? "unknown" : endpoint.address().to_string() + ":" + numberText(endpoint.port());
}

protocol::ByteSpan bytesOf(const beast::flat_buffer& buffer) {
    const auto data = buffer.data();
    return {static_cast<const std::byte*>(data.data()), data.size()};
}

// A client's own code as the metrics may tell it: those of RFC 6455, 0 for any other.
uint16_t codeOfClient(uint16_t code) {
    return code >= 1000 && code <= 1011 ? code : uint16_t{0};
}

// What Beast closes with when it cannot read on.
uint16_t codeSentFor(const beast::error_code& error) {
    if (error == websocket::error::message_too_big || error == websocket::error::buffer_overflow) {
        return websocket::close_code::too_big;
    }
    if (error == websocket::error::bad_frame_payload) {
        return websocket::close_code::bad_payload;
    }
    return error == websocket::condition::protocol_violation
               ? static_cast<uint16_t>(websocket::close_code::protocol_error)
               : uint16_t{1006};
}

} // namespace

WsConnection::WsConnection(PeerStream stream,
                           std::shared_ptr<const Site> site,
                           ConnectionTicket ticket)
    : stream_(std::move(stream)), site_(std::move(site)), ticket_(std::move(ticket)),
      peer_(peerName(stream_.next_layer())), hello_deadline_(stream_.get_executor()),
      write_deadline_(stream_.get_executor()), later_(stream_.get_executor()) {}

WsConnection::~WsConnection() = default;

// Every handler runs through here: on an exception this connection goes, and no other.
template <class Work>
void WsConnection::run(const Work& work) {
    if (!guarded("connection", work)) {
        abandon("internal error");
    }
}

template <class Work>
void WsConnection::onStrand(Work work) {
    asio::post(stream_.get_executor(),
               [self = shared_from_this(), work = std::move(work)]() mutable {
                   if (self->conversation_) {
                       self->run([&] {
                           work(*self->conversation_);
                           self->write();
                       });
                   }
               });
}

// Has something made elsewhere and goes on with it here, if the connection is still there.
template <class Work, class Then>
void WsConnection::aside(Work work, Then then) {
    site_->long_work->run(
        stream_.get_executor(),
        [work = std::move(work)]() mutable {
            std::optional<decltype(work())> made;
            static_cast<void>(guarded("long message", [&] { made = work(); }));
            return made;
        },
        [self = shared_from_this(), then = std::move(then)](auto made, Seconds took) mutable {
            self->reads().count(&ReadBudget::onWork, took, Clock::now());
            if (!made) {
                self->abandon("internal error");
            } else if (self->conversation_) {
                self->run([&] { then(std::move(*made)); });
            }
        });
}

void WsConnection::start(Request upgrade, Caller caller) {
    upgrade_ = std::move(upgrade);
    setOptions();
    conversation_.emplace(weak_from_this(), site_->lobby, site_->metrics, std::move(caller),
                          site_->gate);
    stream_.async_accept(upgrade_, [self = shared_from_this()](ErrorCode error) {
        if (error) {
            self->abandon("handshake: " + error.message());
        } else {
            self->run([&] { self->onAccepted(); });
        }
    });
}

void WsConnection::setOptions() {
    stream_.set_option(websocket::stream_base::timeout{kHandshakeTimeout, kIdleTimeout,
                                                       /*keep_alive_pings=*/true});
    stream_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
        response.set(
            beast::http::field::sec_websocket_protocol,
            beast::string_view(protocol::kSubprotocol.data(), protocol::kSubprotocol.size()));
        response.set(beast::http::field::server, "froxel"); // Beast's has its version
    }));
    // A picture is one WebSocket frame, gathered from header and JPEG without a copy.
    stream_.auto_fragment(false);
    stream_.control_callback([this](websocket::frame_type, beast::string_view) {
        reads().count(&ReadBudget::onControlFrame, Clock::now());
    });
    reads().begin([weak = weak_from_this()](ReadBudget::Standing standing) {
        if (const auto self = weak.lock()) {
            self->onStrand([standing](Conversation& talk) { talk.onFlood(standing); });
        }
    });
}

void WsConnection::onAccepted() {
    upgrade_ = {};
    // From here on the first is the closing handshake's, too.
    stream_.set_option(
        websocket::stream_base::timeout{kCloseTimeout, kIdleTimeout, /*keep_alive_pings=*/true});
    ticket_->waitForClient(
        [strand = stream_.get_executor(), weak = weak_from_this()] {
            asio::post(strand, [weak] {
                if (const auto self = weak.lock()) {
                    self->abandon("it sent nothing, and another connection took its place");
                }
            });
        },
        Clock::now());
    hello_deadline_.expires_after(protocol::kHelloTimeout);
    hello_deadline_.async_wait([self = shared_from_this()](ErrorCode error) {
        if (!error && self->conversation_) {
            self->run([&] {
                self->conversation_->onHelloTimeout();
                self->write();
            });
        }
    });
    site_->service->subscribe(weak_from_this());
    conversation_->onService(site_->service->status(), Clock::now());
    read();
    write();
}

void WsConnection::read() {
    stream_.read_message_max(conversation_->maxMessageBytes());
    stream_.async_read(buffer_, [self = shared_from_this()](ErrorCode error, size_t) {
        self->run([&] { self->onRead(error); });
    });
}

void WsConnection::onReadError(ErrorCode error) {
    if (closing_) {
        onClosed();
    } else if (error == websocket::error::closed) {
        const uint16_t code = stream_.reason().code;
        if (code == websocket::close_code::normal && conversation_) {
            conversation_->onGoodbye();
        }
        abandon("closed by the client", codeOfClient(code));
    } else {
        abandon(error.message(), codeSentFor(error));
    }
}

void WsConnection::onRead(ErrorCode error) {
    if (error) {
        onReadError(error);
        return;
    }
    if (!conversation_) {
        return;
    }
    ticket_->heardClient();
    const bool was_greeted = conversation_->greeted();
    const auto format =
        stream_.got_text() ? protocol::WireFormat::kText : protocol::WireFormat::kBinary;
    reads().count(&ReadBudget::onMessage, Clock::now());
    if (buffer_.size() <= LongWork::kShortBytes) {
        conversation_->onMessage(bytesOf(buffer_), format, Clock::now());
        onHandled(was_greeted);
        return;
    }
    // Nothing is read meanwhile, so the buffer stays as it is, and messages in their order.
    aside([bytes = bytesOf(buffer_), format] { return session::decodeCommand(bytes, format); },
          [this, format, was_greeted](auto command) {
              conversation_->onDecoded(std::move(command), format, Clock::now());
              onHandled(was_greeted);
          });
}

void WsConnection::onHandled(bool was_greeted) {
    buffer_.consume(buffer_.size());
    if (!was_greeted && conversation_->greeted()) {
        hello_deadline_.cancel();
        spdlog::info("event=hello session={} client={} peer={}", conversation_->id(),
                     logValue(conversation_->clientName(), 80), peer_);
    }
    write();
    if (conversation_) {
        read();
    }
}

void WsConnection::write() {
    if (writing_ || closing_ || lingering_ || !conversation_) {
        return;
    }
    writing_ = conversation_->nextMessage(Clock::now());
    if (!writing_) {
        if (conversation_->closing()) {
            closeSocket();
        } else {
            writeLater();
        }
        return;
    }
    if (!writing_->unmade) {
        send();
        return;
    }
    aside(
        [message = *writing_]() mutable {
            message.make();
            return std::move(message);
        },
        [this](Outgoing made) {
            writing_ = std::move(made);
            send();
        });
}

void WsConnection::send() {
    stream_.text(writing_->format == protocol::WireFormat::kText);
    armWriteDeadline(writing_->size());
    const std::array<asio::const_buffer, 2> buffers = {
        asio::buffer(writing_->head),
        writing_->body ? asio::buffer(*writing_->body) : asio::const_buffer()};
    stream_.async_write(buffers, [self = shared_from_this()](ErrorCode error, size_t) {
        self->run([&] { self->onWritten(error); });
    });
}

// What waits only for its time.
void WsConnection::writeLater() {
    const auto at = conversation_->wakeAt(Clock::now());
    if (!at) {
        return;
    }
    later_.expires_at(*at);
    later_.async_wait([self = shared_from_this()](ErrorCode error) {
        if (!error) {
            self->run([&] { self->write(); });
        }
    });
}

void WsConnection::armWriteDeadline(size_t bytes) {
    write_deadline_.expires_after(kWriteTimeout +
                                  std::chrono::seconds(bytes / kSlowestBytesPerSecond));
    write_deadline_.async_wait([self = shared_from_this()](ErrorCode error) {
        const bool due = self->write_deadline_.expiry() <= std::chrono::steady_clock::now();
        if (!error && due && self->writing_) {
            // No close frame gets past the stuck write: the client sees a reset, and the kernel
            // drops what it holds.
            ErrorCode ignored;
            beast::get_lowest_layer(self->stream_)
                .socket()
                .set_option(asio::socket_base::linger(true, 0), ignored);
            self->abandon("a write did not finish",
                          static_cast<uint16_t>(protocol::CloseCode::kSlowConsumer));
        }
    });
}

void WsConnection::onWritten(ErrorCode error) {
    if (!error) {
        site_->metrics->bytesSent(writing_->size());
    }
    writing_.reset();
    write_deadline_.cancel();
    if (error) {
        linger();
    } else {
        write();
    }
}

// A write that fails may be the echo of a read that failed: Beast is then saying why (close 1009,
// say) and reading until the client has heard it. Closing the socket now would reset the connection
// and lose that.
void WsConnection::linger() {
    lingering_ = true;
    if (conversation_) { // nothing reaches it any more: its place is others'
        conversation_->leave();
    }
    write_deadline_.expires_after(2 * PeerStream::kLinger);
    write_deadline_.async_wait([self = shared_from_this()](ErrorCode error) {
        if (!error) {
            self->abandon("nothing can be written");
        }
    });
}

void WsConnection::closeSocket() {
    closing_ = true;
    const Closing& closing = *conversation_->closing();
    const websocket::close_reason reason(
        static_cast<websocket::close_code>(closing.code),
        beast::string_view(closing.reason.data(), closing.reason.size()));
    // A client that does not answer the close is not waited for longer than this.
    write_deadline_.expires_after(kCloseTimeout);
    write_deadline_.async_wait([self = shared_from_this()](ErrorCode error) {
        if (!error) {
            self->onClosed();
        }
    });
    stream_.async_close(reason, [self = shared_from_this()](ErrorCode) { self->onClosed(); });
}

// The client answered the close frame, or the time for that is over. Beast tells the pending read
// and the close in either order; what counts is the code of the close frame.
void WsConnection::onClosed() {
    if (conversation_) {
        const Closing closing = *conversation_->closing();
        abandon(closing.reason, static_cast<uint16_t>(closing.code));
    }
}

// Ends the conversation and lets the socket go; whatever is under way completes with an error.
void WsConnection::abandon(const std::string& why, uint16_t code) {
    if (!conversation_) {
        return;
    }
    site_->metrics->socketClosed(code);
    spdlog::info("event=socket_closed session={} peer={} code={} reason={}", conversation_->id(),
                 peer_, code, logValue(why));
    conversation_.reset();
    hello_deadline_.cancel();
    write_deadline_.cancel();
    later_.cancel();
    beast::get_lowest_layer(stream_).close();
}

void WsConnection::tell(Notice notice) {
    onStrand([notice = std::move(notice)](Conversation& conversation) mutable {
        conversation.onNotice(std::move(notice));
    });
}

void WsConnection::onServiceChanged() {
    onStrand([service = site_->service](Conversation& conversation) {
        conversation.onService(service->status(), Clock::now());
    });
}

} // namespace froxel::net

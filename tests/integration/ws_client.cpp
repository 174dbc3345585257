#include "integration/ws_client.h"

#include "protocol/limits.h"

#include <boost/asio/connect.hpp>
#include <boost/beast/http/field.hpp>

#include <stdexcept>
#include <utility>

namespace froxel::test {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;

WsClient::WsClient(uint16_t port, ClientOptions options) : options_(std::move(options)) {
    auto& socket = stream_.next_layer();
    socket.open(asio::ip::tcp::v4());
    if (options_.receive_buffer_bytes > 0) {
        socket.set_option(asio::socket_base::receive_buffer_size(options_.receive_buffer_bytes));
    }
    socket.connect({asio::ip::address_v4::loopback(), port});
    socket.set_option(asio::ip::tcp::no_delay(true));
    stream_.read_message_max(protocol::kMaxFrameBytes);
    stream_.set_option(websocket::stream_base::decorator([this](websocket::request_type& request) {
        if (!options_.origin.empty()) {
            request.set(beast::http::field::origin, options_.origin);
        }
        if (!options_.forwarded_for.empty()) {
            request.set("X-Forwarded-For", options_.forwarded_for);
        }
        if (!options_.subprotocol.empty()) {
            request.set(beast::http::field::sec_websocket_protocol, options_.subprotocol);
        }
    }));
    websocket::response_type response;
    stream_.handshake(response, "127.0.0.1:" + std::to_string(port), options_.target);
    subprotocol_ = std::string(response[beast::http::field::sec_websocket_protocol]);
}

uint64_t WsClient::send(v1::ClientMessage message) {
    message.set_seq(++last_seq_);
    message.set_client_time_us(1000 * last_seq_);
    sendRaw(protocol::encodeClientMessage(message, options_.format), options_.format);
    return last_seq_;
}

uint64_t WsClient::hello(const std::string& room, const std::string& resume_token) {
    v1::ClientMessage message;
    message.mutable_hello()->set_protocol_major(protocol::kMajor);
    message.mutable_hello()->set_client_name("integration test");
    message.mutable_hello()->set_room(room);
    message.mutable_hello()->set_resume_token(resume_token);
    return send(message);
}

void WsClient::sendRaw(std::string_view bytes, protocol::WireFormat format) {
    stream_.text(format == protocol::WireFormat::kText);
    stream_.write(asio::buffer(bytes.data(), bytes.size()));
}

void WsClient::ack(uint64_t frame_id) {
    v1::ClientMessage message;
    message.mutable_ack()->set_frame_id(frame_id);
    send(message);
}

WsClient::Received WsClient::parse() {
    const auto data = buffer_.data();
    const protocol::ByteSpan bytes(static_cast<const std::byte*>(data.data()), data.size());
    received_bytes_ += bytes.size();
    Received received;
    if (!stream_.got_text() && protocol::binaryKind(bytes).value() == protocol::Kind::kFrame) {
        Frame frame;
        const auto jpeg = protocol::decodeFrame(bytes, frame.header).value();
        frame.jpeg.assign(jpeg.begin(), jpeg.end());
        received.frame = std::move(frame);
    } else {
        v1::ServerMessage message;
        const auto format =
            stream_.got_text() ? protocol::WireFormat::kText : protocol::WireFormat::kBinary;
        protocol::decodeServerMessage(bytes, format, message).value();
        received.message = std::move(message);
    }
    buffer_.consume(buffer_.size());
    return received;
}

std::optional<WsClient::Received> WsClient::receive(std::chrono::milliseconds timeout) {
    if (!reading_) {
        reading_ = true;
        read_result_.reset();
        stream_.async_read(buffer_, [this](boost::system::error_code error, size_t) {
            reading_ = false;
            read_result_ = error;
        });
    }
    const auto end = std::chrono::steady_clock::now() + timeout;
    io_.restart();
    while (!read_result_ && io_.run_one_until(end) > 0) {
    }
    if (!read_result_) {
        return {};
    }
    Received received;
    if (*read_result_) {
        const bool orderly = *read_result_ == websocket::error::closed;
        received.closed =
            orderly ? Closed{stream_.reason().code, std::string(stream_.reason().reason.c_str())}
                    : Closed{0, read_result_->message()};
        return received;
    }
    received = parse();
    if (received.frame && options_.auto_ack) {
        ack(received.frame->header.frame_id());
    }
    return received;
}

WsClient::Received WsClient::receiveOrThrow(const char* what) {
    auto received = receive(kTimeout);
    if (!received) {
        throw std::runtime_error(std::string("timed out waiting for ") + what);
    }
    if (received->closed) {
        throw std::runtime_error(std::string("closed while waiting for ") + what + ": " +
                                 std::to_string(received->closed->code) + " " +
                                 received->closed->reason);
    }
    return std::move(*received);
}

v1::ServerMessage WsClient::expect(v1::ServerMessage::BodyCase body) {
    for (;;) {
        const Received received = receiveOrThrow("a server message");
        if (received.message && received.message->body_case() == body) {
            return *received.message;
        }
    }
}

v1::ServerMessage WsClient::expectErrorOr(v1::ServerMessage::BodyCase body) {
    for (;;) {
        const Received received = receiveOrThrow("an answer or an error");
        if (received.message &&
            (received.message->body_case() == body || received.message->has_error())) {
            return *received.message;
        }
    }
}

v1::ViewState WsClient::expectState(uint64_t seq) {
    for (;;) {
        const v1::ServerMessage message = expect(v1::ServerMessage::kState);
        if (message.state().ref_seq() >= seq) {
            return message.state().state();
        }
    }
}

Frame WsClient::expectFrame(const std::function<bool(const v1::FrameHeader&)>& wanted) {
    const auto end = std::chrono::steady_clock::now() + kTimeout;
    while (std::chrono::steady_clock::now() < end) {
        Received received = receiveOrThrow("a frame");
        if (received.frame && (!wanted || wanted(received.frame->header))) {
            return std::move(*received.frame);
        }
    }
    throw std::runtime_error("no frame was the one waited for");
}

bool WsClient::quietFor(std::chrono::milliseconds time) {
    return !receive(time);
}

Closed WsClient::expectClosed() {
    const auto end = std::chrono::steady_clock::now() + kTimeout;
    while (std::chrono::steady_clock::now() < end) {
        if (const auto received = receive(kTimeout); received && received->closed) {
            return *received->closed;
        }
    }
    throw std::runtime_error("the connection stayed open");
}

v1::Welcome WsClient::join(const std::string& room, const std::string& resume_token) {
    hello(room, resume_token);
    return expect(v1::ServerMessage::kWelcome).welcome();
}

void WsClient::close() {
    boost::system::error_code ignored;
    stream_.close(websocket::close_code::normal, ignored);
}

void WsClient::abort() {
    auto& socket = stream_.next_layer();
    socket.set_option(asio::socket_base::linger(true, 0));
    socket.close();
}

} // namespace froxel::test

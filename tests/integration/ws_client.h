// A viewer without a page: speaks the protocol over a real socket. One thread.
#pragma once

#include "froxel/v1/client.pb.h"
#include "froxel/v1/server.pb.h"
#include "protocol/framing.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace froxel::test {

struct ClientOptions {
    std::string origin{};                  // empty: none is sent
    std::string subprotocol = "froxel.v1"; // empty: none
    protocol::WireFormat format = protocol::WireFormat::kBinary;
    bool auto_ack = true;
    int receive_buffer_bytes = 0; // SO_RCVBUF; 0: the kernel's
    std::string target = "/ws";
    std::string forwarded_for{}; // as a proxy says it; empty: not at all
};

struct Frame {
    v1::FrameHeader header;
    std::vector<std::byte> jpeg;
};

// The connection ended: the close code, 0 when it broke without one.
struct Closed {
    uint16_t code = 0;
    std::string reason;
};

class WsClient {
  public:
    static constexpr std::chrono::seconds kTimeout{60};

    // Connects to 127.0.0.1; throws boost::system::system_error when the upgrade is refused.
    explicit WsClient(uint16_t port, ClientOptions options = {});

    // Sends it under the next seq and returns that.
    uint64_t send(v1::ClientMessage message);
    uint64_t hello(const std::string& room = "", const std::string& resume_token = "");
    void sendRaw(std::string_view bytes, protocol::WireFormat format);
    void ack(uint64_t frame_id);

    // The next message of this kind; frames and others pass by (frames acknowledged with
    // auto_ack). Throws std::runtime_error when the connection ends or after kTimeout.
    v1::ServerMessage expect(v1::ServerMessage::BodyCase body);
    v1::Error expectError() { return expect(v1::ServerMessage::kError).error(); }
    // The first of this kind, or Error.
    v1::ServerMessage expectErrorOr(v1::ServerMessage::BodyCase body);
    v1::ServerMessage expectAnswer() { return expectErrorOr(v1::ServerMessage::kWelcome); }
    // The state that answers `seq` or a later command.
    v1::ViewState expectState(uint64_t seq);
    Frame expectFrame(const std::function<bool(const v1::FrameHeader&)>& wanted = {});
    // Whether nothing but pings comes for this long.
    bool quietFor(std::chrono::milliseconds time);
    // Reads until the connection ends.
    Closed expectClosed();

    // Says Hello and waits for Welcome.
    v1::Welcome join(const std::string& room = "", const std::string& resume_token = "");
    void close();
    // Resets the connection without a word.
    void abort();

    [[nodiscard]] const std::string& acceptedSubprotocol() const { return subprotocol_; }
    [[nodiscard]] uint64_t receivedBytes() const { return received_bytes_; }

  private:
    struct Received {
        std::optional<Frame> frame;
        std::optional<v1::ServerMessage> message;
        std::optional<Closed> closed;
    };
    std::optional<Received> receive(std::chrono::milliseconds timeout);
    Received receiveOrThrow(const char* what);
    Received parse();

    const ClientOptions options_;
    boost::asio::io_context io_;
    boost::beast::websocket::stream<boost::asio::ip::tcp::socket> stream_{io_};
    boost::beast::flat_buffer buffer_;
    bool reading_ = false;
    std::optional<boost::system::error_code> read_result_;
    uint64_t last_seq_ = 0;
    uint64_t received_bytes_ = 0;
    std::string subprotocol_;
};

} // namespace froxel::test

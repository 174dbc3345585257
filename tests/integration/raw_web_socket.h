// A WebSocket by hand, for what no library would send. One thread.
#pragma once

#include "integration/http_exchange.h"

#include <arpa/inet.h>
#include <cstdint>
#include <netinet/in.h>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace froxel::test {

inline std::string upgradeRequest() {
    return "GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\n"
           "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
           "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
           "Sec-WebSocket-Protocol: froxel.v1\r\n\r\n";
}

class RawWebSocket {
  public:
    // Opcodes with FIN, RFC 6455 section 5.2.
    static constexpr uint8_t kText = 0x81;
    static constexpr uint8_t kBinary = 0x82;
    static constexpr uint8_t kClose = 0x88;
    static constexpr uint8_t kPing = 0x89;
    static constexpr uint8_t kPong = 0x8A;

    struct Frame {
        uint8_t first = 0; // FIN, reserved bits, opcode
        std::string payload;
    };

    // Connects to 127.0.0.1; with `upgrade` also shakes hands.
    explicit RawWebSocket(uint16_t port, bool upgrade = true)
        : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        const timeval timeout{20, 0};
        ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_port = htons(port);
        to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        if (::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0) {
            throw std::runtime_error("cannot connect");
        }
        if (upgrade) {
            send(upgradeRequest());
            const std::string answer = readHeader();
            if (statusOf(answer) != 101) {
                throw std::runtime_error(answer);
            }
        }
    }
    ~RawWebSocket() { ::close(socket_); }
    RawWebSocket(const RawWebSocket&) = delete;
    RawWebSocket& operator=(const RawWebSocket&) = delete;

    // False when the server has closed.
    bool send(std::string_view bytes) const {
        while (!bytes.empty()) {
            const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
            if (sent <= 0) {
                return false;
            }
            bytes.remove_prefix(static_cast<size_t>(sent));
        }
        return true;
    }
    void endSending() const { ::shutdown(socket_, SHUT_WR); }

    // A frame masked with a key of zeros, which leaves the payload as it is.
    static std::string frame(uint8_t first, std::string_view payload) {
        std::string bytes = head(first, 0x80, payload.size());
        bytes.append(4, '\0');
        return bytes.append(payload);
    }
    // First byte, mask bit and length, in the shortest form for it.
    static std::string head(uint8_t first, uint8_t mask, uint64_t length) {
        std::string bytes(1, static_cast<char>(first));
        const int extra = length < 126 ? 0 : length < 65536 ? 2 : 8;
        const auto code = extra == 0 ? length : extra == 2 ? 126U : 127U;
        bytes += static_cast<char>(mask | code);
        for (int i = extra - 1; i >= 0; --i) {
            bytes += static_cast<char>(length >> (8U * static_cast<unsigned>(i)));
        }
        return bytes;
    }

    // The server's next frame; none when the connection ended or nothing came for 20 s.
    std::optional<Frame> read() {
        const auto two = readExactly(2);
        if (!two) {
            return {};
        }
        uint64_t length = static_cast<uint8_t>((*two)[1]);
        if (length >= 126) {
            const auto more = readExactly(length == 126 ? 2 : 8);
            length = 0;
            for (const char byte : more.value_or("")) {
                length = length << 8U | static_cast<uint8_t>(byte);
            }
        }
        auto payload = readExactly(length);
        if (!payload) {
            return {};
        }
        return Frame{static_cast<uint8_t>((*two)[0]), std::move(*payload)};
    }
    // Reads on until a close frame; its code, 0 when the connection ended without one.
    uint16_t closeCode() {
        while (const auto got = read()) {
            if (got->first == kClose && got->payload.size() >= 2) {
                return static_cast<uint16_t>(static_cast<uint8_t>(got->payload[0]) << 8U |
                                             static_cast<uint8_t>(got->payload[1]));
            }
        }
        return 0;
    }
    // Whether the server closes within 20 s, whatever it sends before.
    bool ends() {
        char byte = 0;
        ssize_t got = 0;
        while ((got = ::recv(socket_, &byte, 1, 0)) > 0) {
        }
        return got == 0 || errno == ECONNRESET;
    }

    // Of an HTTP answer, to the empty line.
    std::string readHeader() {
        std::string answer;
        while (answer.find("\r\n\r\n") == std::string::npos) {
            answer += readExactly(1).value();
        }
        return answer;
    }

  private:
    std::optional<std::string> readExactly(uint64_t count) {
        std::string bytes(count, '\0');
        for (uint64_t at = 0; at < count;) {
            const ssize_t got = ::recv(socket_, bytes.data() + at, count - at, 0);
            if (got <= 0) {
                return {};
            }
            at += static_cast<uint64_t>(got);
        }
        return bytes;
    }

    int socket_;
};

} // namespace froxel::test

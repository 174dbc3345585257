// A TCP relay that makes loopback a slow link: each direction of each connection has a bounded
// queue, a rate and a delay (shaped_link.h). It reads no more than its queue takes, and its sockets
// have small buffers, so that the sender feels the link and nothing hides megabytes of queue.
#pragma once

#include "relay/shaped_link.h"

#include <cstdint>
#include <memory>
#include <string>

namespace froxel::test {

struct RelayOptions {
    uint16_t listen_port = 0; // of 127.0.0.1; 0: any free one
    std::string host = "127.0.0.1";
    uint16_t port = 0;
    LinkOptions up{};   // from whoever connects to `host`
    LinkOptions down{}; // and back
};

class Relay {
  public:
    // Of each of its sockets, in either direction.
    static constexpr int kSocketBufferBytes = 16 * 1024;

    // Listens when it returns. Throws boost::system::system_error.
    explicit Relay(const RelayOptions& options);
    // Cuts every connection.
    ~Relay();
    Relay(const Relay&) = delete;
    Relay& operator=(const Relay&) = delete;

    [[nodiscard]] uint16_t port() const;
    // Of all connections there are and will be. Any thread.
    void setRate(double up_bytes_per_s, double down_bytes_per_s);
    // Bytes that came out of it so far, up and down. Any thread.
    [[nodiscard]] uint64_t upBytes() const;
    [[nodiscard]] uint64_t downBytes() const;
    // Waits until that many came down; whether they did in time. Any thread.
    [[nodiscard]] bool waitForDown(uint64_t bytes, std::chrono::milliseconds timeout) const;

  private:
    struct Impl;
    const std::unique_ptr<Impl> impl_;
};

} // namespace froxel::test

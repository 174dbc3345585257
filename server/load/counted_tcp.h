// A viewer's connection.
#pragma once

#include "transport/peer_stream.h"

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <boost/beast/core/rate_policy.hpp>

#include <cstdint>
#include <limits>

namespace froxel::load {

// Limits nothing and counts every byte of the connection, pings and framing included.
class ByteCounter {
  public:
    [[nodiscard]] uint64_t receivedBytes() const { return received_; }
    [[nodiscard]] uint64_t sentBytes() const { return sent_; }

  private:
    friend class boost::beast::rate_policy_access;
    static constexpr size_t kAll = std::numeric_limits<size_t>::max();
    // Names that Beast calls.
    [[nodiscard]] size_t available_read_bytes() const { return kAll; }
    [[nodiscard]] size_t available_write_bytes() const { return kAll; }
    void transfer_read_bytes(size_t bytes) { received_ += bytes; }
    void transfer_write_bytes(size_t bytes) { sent_ += bytes; }
    void on_timer() const {}

    uint64_t received_ = 0;
    uint64_t sent_ = 0;
};

using CountedTcp =
    boost::beast::basic_stream<boost::asio::ip::tcp, boost::asio::any_io_executor, ByteCounter>;

} // namespace froxel::load

extern template class froxel::transport::PeerStream<froxel::load::CountedTcp>;

// The relay between two real sockets.
#include "relay/relay.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <gtest/gtest.h>

#include <sys/socket.h>
#include <utility>

namespace froxel::test {
namespace {

using namespace std::chrono_literals;
namespace asio = boost::asio;
using asio::ip::tcp;

// A connection through a relay, both ends of it in this thread.
class RelayedPair : public testing::Test {
  protected:
    void open(RelayOptions options) {
        options.port = acceptor_.local_endpoint().port();
        relay_.emplace(options);
        client_.connect({asio::ip::address_v4::loopback(), relay_->port()});
        server_ = acceptor_.accept();
    }

    asio::io_context io_;
    tcp::acceptor acceptor_{io_, {asio::ip::address_v4::loopback(), 0}};
    std::optional<Relay> relay_;
    tcp::socket client_{io_};
    tcp::socket server_{io_};
};

TEST_F(RelayedPair, Bytes_BothWays_ArriveUnchanged) {
    open({});
    std::vector<uint8_t> sent(10'000);
    for (size_t index = 0; index < sent.size(); ++index) {
        sent[index] = static_cast<uint8_t>(index * 7);
    }
    std::vector<uint8_t> received(sent.size());
    asio::write(client_, asio::buffer(sent));
    asio::read(server_, asio::buffer(received));
    EXPECT_EQ(received, sent);
    std::reverse(sent.begin(), sent.end());
    asio::write(server_, asio::buffer(sent));
    asio::read(client_, asio::buffer(received));
    EXPECT_EQ(received, sent);
    EXPECT_EQ(relay_->upBytes(), sent.size());
}

TEST_F(RelayedPair, Rate_IsNeverExceeded) {
    RelayOptions options;
    options.down.bytes_per_s = 200'000;
    open(options);
    std::vector<uint8_t> bytes(40'000);
    const TimePoint start = Clock::now();
    asio::write(server_, asio::buffer(bytes)); // fits into buffers on the way
    asio::read(client_, asio::buffer(bytes));
    EXPECT_GE(Clock::now() - start, 180ms); // 200 ms less a burst and its full bucket
}

TEST_F(RelayedPair, Delay_IsAddedEachWay) {
    RelayOptions options;
    options.up.delay = 30ms;
    options.down.delay = 20ms;
    open(options);
    uint8_t byte = 1;
    const TimePoint start = Clock::now();
    asio::write(client_, asio::buffer(&byte, 1));
    asio::read(server_, asio::buffer(&byte, 1));
    asio::write(server_, asio::buffer(&byte, 1));
    asio::read(client_, asio::buffer(&byte, 1));
    EXPECT_GE(Clock::now() - start, 50ms);
}

TEST_F(RelayedPair, Stopped_HoldsLittleAndPushesBack_ThenDeliversIt) {
    RelayOptions options;
    options.down = {0, 0us, 32 * 1024};
    open(options);
    server_.set_option(asio::socket_base::send_buffer_size(16 * 1024));
    server_.non_blocking(true);
    const std::vector<uint8_t> bytes(16 * 1024);
    size_t written = 0;
    // Until the sender is stopped for as long as any byte could need to get on.
    for (TimePoint last = Clock::now(); Clock::now() - last < 300ms;) {
        boost::system::error_code full;
        const size_t size = server_.write_some(asio::buffer(bytes), full);
        if (size > 0) {
            written += size;
            last = Clock::now();
            ASSERT_LT(written, 512U * 1024) << "the relay keeps what it cannot send";
        }
    }
    EXPECT_GE(written, 32U * 1024);
    relay_->setRate(TokenBucket::kUnlimited, TokenBucket::kUnlimited);
    std::vector<uint8_t> received(written);
    EXPECT_EQ(asio::read(client_, asio::buffer(received)), written);
}

TEST_F(RelayedPair, End_OfOneSide_ReachesTheOtherAfterItsBytes) {
    RelayOptions options;
    options.up.delay = 20ms;
    open(options);
    asio::write(client_, asio::buffer("last", 4));
    client_.shutdown(tcp::socket::shutdown_send);
    std::string heard(16, ' ');
    boost::system::error_code end;
    EXPECT_EQ(asio::read(server_, asio::buffer(heard), end), 4U);
    EXPECT_EQ(end, asio::error::eof);
}

TEST(Relay, Server_Absent_ClosesTheConnection) {
    asio::io_context io;
    uint16_t unused = 0;
    {
        const tcp::acceptor gone(io, {asio::ip::address_v4::loopback(), 0});
        unused = gone.local_endpoint().port();
    }
    RelayOptions options;
    options.port = unused;
    const Relay relay(options);
    tcp::socket client(io);
    client.connect({asio::ip::address_v4::loopback(), relay.port()});
    char byte = 0;
    boost::system::error_code end;
    EXPECT_EQ(asio::read(client, asio::buffer(&byte, 1), end), 0U);
    EXPECT_TRUE(end);
}

} // namespace
} // namespace froxel::test

#include "net/connection_tickets.h"

#include <gtest/gtest.h>

#include <vector>

namespace froxel::net {
namespace {

using boost::asio::ip::make_address;

TEST(ConnectionTickets, Ipv6Network_HasTheShareOfOneAddress) {
    ConnectionTickets tickets(8);
    std::vector<ConnectionTicket> held;
    for (const char* address : {"2001:db8::1", "2001:db8::2", "2001:db8::ffff:0:0:3"}) {
        held.push_back(tickets.take(make_address(address), 3));
        EXPECT_TRUE(held.back()) << address;
    }
    EXPECT_FALSE(tickets.take(make_address("2001:db8::4"), 3));
    EXPECT_TRUE(tickets.take(make_address("2001:db8:0:1::4"), 3));
}

TEST(ConnectionTickets, Ipv4InIpv6_IsThatIpv4Address) {
    ConnectionTickets tickets(8);
    const auto held = tickets.take(make_address("::ffff:192.0.2.1"), 1);
    EXPECT_FALSE(tickets.take(make_address("192.0.2.1"), 1));
    EXPECT_TRUE(tickets.take(make_address("192.0.2.2"), 1));
}

TEST(ConnectionTickets, AllAreTaken_NobodyGetsOneUntilOneEnds) {
    ConnectionTickets tickets(2);
    auto first = tickets.take(make_address("192.0.2.1"), 2);
    const auto second = tickets.take(make_address("192.0.2.2"), 2);
    EXPECT_FALSE(tickets.take(make_address("192.0.2.3"), 2));
    first.reset();
    EXPECT_TRUE(tickets.take(make_address("192.0.2.3"), 2));
}

TEST(ConnectionTickets, Ticket_OutlivesItsListener) {
    ConnectionTicket ticket;
    {
        ConnectionTickets tickets(1);
        ticket = tickets.take(make_address("192.0.2.1"), 1);
    }
    EXPECT_TRUE(ticket);
}

} // namespace
} // namespace froxel::net

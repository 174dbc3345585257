#include "net/connection_tickets.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace froxel::net {
namespace {

using boost::asio::ip::make_address;
using namespace std::chrono_literals;

const TimePoint kNow{};

TEST(ConnectionTickets, Ipv6Network_HasTheShareOfOneAddress) {
    ConnectionTickets tickets(8);
    std::vector<ConnectionTicket> held;
    for (const char* address : {"2001:db8::1", "2001:db8::2", "2001:db8::ffff:0:0:3"}) {
        held.push_back(tickets.take(make_address(address), 3, kNow));
        EXPECT_TRUE(held.back()) << address;
    }
    EXPECT_FALSE(tickets.take(make_address("2001:db8::4"), 3, kNow));
    EXPECT_TRUE(tickets.take(make_address("2001:db8:0:1::4"), 3, kNow));
}

TEST(ConnectionTickets, Ipv4InIpv6_IsThatIpv4Address) {
    ConnectionTickets tickets(8);
    const auto held = tickets.take(make_address("::ffff:192.0.2.1"), 1, kNow);
    EXPECT_FALSE(tickets.take(make_address("192.0.2.1"), 1, kNow));
    EXPECT_TRUE(tickets.take(make_address("192.0.2.2"), 1, kNow));
}

TEST(ConnectionTickets, AllAreTaken_NobodyGetsOneUntilOneEnds) {
    ConnectionTickets tickets(2);
    auto first = tickets.take(make_address("192.0.2.1"), 2, kNow);
    const auto second = tickets.take(make_address("192.0.2.2"), 2, kNow);
    EXPECT_FALSE(tickets.take(make_address("192.0.2.3"), 2, kNow));
    first.reset();
    EXPECT_TRUE(tickets.take(make_address("192.0.2.3"), 2, kNow));
}

class Crowd {
  public:
    explicit Crowd(uint32_t most) : tickets_(most) {}

    // Whether it got a place; it waits for its client from then on.
    bool enter(const std::string& address, TimePoint now, uint32_t account_max = 8) {
        auto ticket = tickets_.take(make_address(address), account_max, now);
        if (ticket) {
            ticket->waitForClient([this, address, now] { gone.emplace_back(address, now); }, now);
            held.push_back(std::move(ticket));
        }
        return held.size() > std::exchange(count_, held.size());
    }

    std::vector<ConnectionTicket> held;
    std::vector<std::pair<std::string, TimePoint>> gone;

  private:
    ConnectionTickets tickets_;
    size_t count_ = 0;
};

TEST(ConnectionTickets, SilentOnes_GiveWayToNewcomersOfOtherAddresses) {
    Crowd crowd(4);
    for (int i = 0; i < 2; ++i) {
        EXPECT_TRUE(crowd.enter("192.0.2.1", kNow + i * 1ms));
        EXPECT_TRUE(crowd.enter("192.0.2.2", kNow + i * 1ms));
    }
    EXPECT_TRUE(crowd.enter("192.0.2.3", kNow + 10ms));
    ASSERT_EQ(crowd.gone.size(), 1U) << "the one that has waited longest, of who has most";
    EXPECT_EQ(crowd.gone[0].second, kNow);
    EXPECT_FALSE(crowd.enter("192.0.2.3", kNow + 10ms)) << "another would have no more than it";
}

TEST(ConnectionTickets, ThoseThatHaveSaidSomething_Stay) {
    Crowd crowd(3);
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(crowd.enter("192.0.2.1", kNow));
        crowd.held.back()->heardClient();
    }
    EXPECT_FALSE(crowd.enter("192.0.2.3", kNow + 10s));
    EXPECT_TRUE(crowd.gone.empty());
}

TEST(ConnectionTickets, OwnSilentOnes_GiveWayAfterASecond) {
    Crowd crowd(8);
    EXPECT_TRUE(crowd.enter("192.0.2.1", kNow, 1));
    EXPECT_FALSE(crowd.enter("192.0.2.1", kNow + 999ms, 1));
    EXPECT_TRUE(crowd.enter("192.0.2.1", kNow + 1s, 1));
    EXPECT_EQ(crowd.gone.size(), 1U);
}

TEST(ConnectionTickets, OneThatHadToGo_CountsNoMoreAndGoesOnce) {
    Crowd crowd(1);
    EXPECT_TRUE(crowd.enter("192.0.2.1", kNow));
    EXPECT_TRUE(crowd.enter("192.0.2.1", kNow + 1s));
    crowd.held[0]->waitForClient([] { FAIL() << "it has gone"; }, kNow + 1s);
    crowd.held.erase(crowd.held.begin());
    EXPECT_FALSE(crowd.enter("192.0.2.2", kNow + 1s)) << "the second one is still there";
    crowd.held.clear();
    EXPECT_EQ(crowd.gone.size(), 1U);
}

TEST(ConnectionTickets, Ticket_OutlivesItsListener) {
    ConnectionTicket ticket;
    {
        ConnectionTickets tickets(1);
        ticket = tickets.take(make_address("192.0.2.1"), 1, kNow);
    }
    EXPECT_TRUE(ticket);
}

} // namespace
} // namespace froxel::net

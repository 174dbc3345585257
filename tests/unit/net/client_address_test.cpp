#include "net/client_address.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace froxel::net {
namespace {

using boost::asio::ip::make_address;

std::string clientOf(const std::string& peer,
                     const std::string& forwarded_for,
                     const std::vector<std::string>& proxies) {
    return clientAddress(make_address(peer), forwarded_for, TrustedProxies::parse(proxies).value())
        .to_string();
}

std::string accountOf(const std::string& address) {
    return callerAt(make_address(address)).address.key;
}

TEST(ClientAddress, NoProxyTrusted_IsThePeerWhateverItSays) {
    EXPECT_EQ(clientOf("192.0.2.7", "198.51.100.1", {}), "192.0.2.7");
    EXPECT_EQ(clientOf("192.0.2.7", "198.51.100.1", {"10.0.0.0/8"}), "192.0.2.7");
}

TEST(ClientAddress, BehindTrustedProxies_IsTheLastHopThatIsNoneOfThem) {
    const std::vector<std::string> proxies{"10.0.0.0/8", "fd00::/8", "203.0.113.9"};
    EXPECT_EQ(clientOf("10.1.2.3", "198.51.100.1", proxies), "198.51.100.1");
    EXPECT_EQ(clientOf("10.1.2.3", "1.1.1.1, 198.51.100.1 ,10.9.9.9", proxies), "198.51.100.1")
        << "what a client wrote itself stands first";
    EXPECT_EQ(clientOf("203.0.113.9", "2001:db8::1,fd12::4", proxies), "2001:db8::1");
    EXPECT_EQ(clientOf("::ffff:10.1.2.3", "198.51.100.1", proxies), "198.51.100.1");
}

// Azure's Application Gateway and IIS write the viewer's port behind the address.
TEST(ClientAddress, WithAPort_IsTheAddressAlone) {
    for (const auto& [hop, address] :
         {std::pair("203.0.113.9:1111", "203.0.113.9"), std::pair("[2001:db8::1]:1", "2001:db8::1"),
          std::pair("[2001:db8::1]", "2001:db8::1"), std::pair("2001:db8::1", "2001:db8::1"),
          std::pair("8.8.8.8, 203.0.113.9:65535", "203.0.113.9")}) {
        EXPECT_EQ(clientOf("10.0.0.1", hop, {"10.0.0.0/8"}), address) << hop;
    }
    for (const char* hop : {"203.0.113.9:", "203.0.113.9:http", "[2001:db8::1", "[2001:db8::1]x",
                            "[2001:db8::1]:", "[203.0.113.9]:1x", ":80", "[]:80"}) {
        EXPECT_EQ(clientOf("10.0.0.1", hop, {"10.0.0.0/8"}), "10.0.0.1") << hop;
    }
}

TEST(ClientAddress, TrustedProxySaysNoAddress_IsTheProxy) {
    const std::vector<std::string> proxies{"10.0.0.0/8"};
    for (const char* said : {"", "unknown", ",", "198.51.100.1, who", "198.51.100.1:x"}) {
        EXPECT_EQ(clientOf("10.1.2.3", said, proxies), "10.1.2.3") << said;
    }
}

bool encrypted(const std::string& forwarded_proto,
               const std::string& forwarded_for = "",
               const std::vector<std::string>& proxies = {}) {
    return cameByTls(make_address("10.0.0.1"), forwarded_for, forwarded_proto,
                     TrustedProxies::parse(proxies).value());
}

TEST(CameByTls, OnlyWhatIsKnownToBePlain_IsPlain) {
    for (const char* plain : {"", "http", "HTTP", "ws", " http ", "http,http"}) {
        EXPECT_FALSE(encrypted(plain)) << plain;
    }
    for (const char* said : {"https", "HTTPS", "wss", "https, https", "https,http", "http,https",
                             "h2", "http;", "on"}) {
        EXPECT_TRUE(encrypted(said)) << said;
    }
}

TEST(CameByTls, BehindTrustedProxies_TheOutermostThatTheyWroteCounts) {
    const std::vector<std::string> proxies{"10.0.0.0/8"};
    const std::string from_viewer = "198.51.100.1";
    const std::string over_two = "198.51.100.1, 10.0.0.2";
    EXPECT_TRUE(encrypted("http, https", from_viewer, proxies)) << "the viewer wrote the first";
    EXPECT_FALSE(encrypted("https, http", from_viewer, proxies));
    EXPECT_FALSE(encrypted("http, https", over_two, proxies)) << "TLS between proxies";
    EXPECT_TRUE(encrypted("https, http", over_two, proxies));
    EXPECT_TRUE(encrypted("https", over_two, proxies)) << "handed on as it was";
    EXPECT_TRUE(encrypted("wss", from_viewer, proxies));
}

TEST(ClientAddress, Account_IsAnIpv4AddressOrAnIpv6NetworkOf64Bits) {
    EXPECT_EQ(accountOf("192.0.2.7"), "192.0.2.7");
    EXPECT_EQ(accountOf("::ffff:192.0.2.7"), "192.0.2.7");
    EXPECT_EQ(accountOf("2001:db8:1:2:3:4:5:6"), "2001:db8:1:2::/64");
    EXPECT_EQ(accountOf("2001:db8:1:2::1"), accountOf("2001:db8:1:2:ffff::"));
    EXPECT_NE(accountOf("2001:db8:1:2::1"), accountOf("2001:db8:1:3::1"));
    EXPECT_EQ(accountOf("fe80::1%3"), accountOf("fe80::2%4")) << "on whichever card";
}

TEST(ClientAddress, AProxyOnThisHost_IsLocal) {
    for (const char* local : {"127.0.0.1", "::1", "::ffff:127.0.0.1"}) {
        EXPECT_TRUE(callerAt(make_address(local)).local) << local;
    }
    for (const char* other : {"127.8.9.10", "192.168.0.1", "fe80::1"}) {
        EXPECT_FALSE(callerAt(make_address(other)).local) << other;
    }
}

TEST(TrustedProxies, NoNetwork_IsRefusedAndQuoted) {
    for (const char* wrong : {"", "10.0.0.0/33", "10.0.0/8", "host", "fd00::/129", "10.0.0.0/-1"}) {
        const auto parsed = TrustedProxies::parse({"10.0.0.1", wrong});
        ASSERT_FALSE(parsed) << wrong;
        EXPECT_THAT(parsed.error().message, testing::HasSubstr("'" + std::string(wrong) + "'"));
    }
}

} // namespace
} // namespace froxel::net

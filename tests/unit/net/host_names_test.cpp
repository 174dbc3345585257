#include "net/host_names.h"

#include <gtest/gtest.h>

namespace froxel::net {
namespace {

TEST(HostNames, Loopback_AnswersToLocalhostAndAddresses) {
    for (const char* bound : {"127.0.0.1", "127.8.8.8", "::1"}) {
        const HostNames names({}, bound);
        for (const char* host : {"localhost", "LocalHost:8080", "127.0.0.1", "127.0.0.1:8080",
                                 "10.1.2.3:9090", "[::1]", "[::1]:8080", "[2001:db8::1]:80", ""}) {
            EXPECT_TRUE(names.contain(host)) << bound << " " << host;
        }
    }
}

TEST(HostNames, RootsDot_DoesNotCount) {
    EXPECT_TRUE(HostNames({}, "127.0.0.1").contain("localhost.:8080"));
    EXPECT_TRUE(HostNames({"froxel.example."}, "0.0.0.0").contain("Froxel.example"));
    EXPECT_FALSE(HostNames({}, "127.0.0.1").contain("localhost.."));
    EXPECT_FALSE(HostNames({}, "127.0.0.1").contain("."));
}

TEST(HostNames, Loopback_RefusesOtherNames) {
    const HostNames names({}, "127.0.0.1");
    for (const char* host :
         {"evil.example", "evil.example:8080", "localhost.evil.example", "127.0.0.1.evil.example",
          "localhost@evil.example", "127.0.0.1:80@evil.example", "evil.example:80:80", " localhost",
          "[::1", ":8080", "a b"}) {
        EXPECT_FALSE(names.contain(host)) << host;
    }
}

TEST(HostNames, Configured_AreAnsweredToOnAnyAddress) {
    for (const char* bound : {"127.0.0.1", "0.0.0.0"}) {
        const HostNames names({"froxel.example"}, bound);
        EXPECT_TRUE(names.contain("FROXEL.example:443")) << bound;
        EXPECT_TRUE(names.contain("localhost")) << bound;
        EXPECT_TRUE(names.contain("10.0.0.7:9090")) << bound << ": a probe";
        EXPECT_FALSE(names.contain("www.froxel.example")) << bound;
    }
}

TEST(HostNames, NotLoopbackAndNoneConfigured_AnyIsAnsweredTo) {
    EXPECT_TRUE(HostNames({}, "0.0.0.0").contain("whoever.example"));
    EXPECT_TRUE(HostNames({}, "192.168.1.2").contain("whoever.example"));
    EXPECT_TRUE(HostNames().contain("whoever.example"));
}

TEST(HostNames, IsHostName_OnlyNames) {
    EXPECT_TRUE(isHostName("froxel.example"));
    for (const char* text : {"", "a:80", "http://a", "a/b", "a b", "*.example"}) {
        EXPECT_FALSE(isHostName(text)) << text;
    }
}

} // namespace
} // namespace froxel::net

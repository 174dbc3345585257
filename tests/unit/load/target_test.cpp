#include "load/target.h"

#include <gtest/gtest.h>

namespace froxel::load {
namespace {

TEST(Target, Url_InFull_IsTakenApart) {
    const Target expected{"server.example", "8081", "server.example:8081", "/a/ws?room=hall"};
    EXPECT_EQ(parseTarget("ws://server.example:8081/a/ws?room=hall").value(), expected);
}

TEST(Target, Url_OfTheServer_GetsItsPath) {
    const Target expected{"127.0.0.1", "8080", "127.0.0.1:8080", "/ws"};
    EXPECT_EQ(parseTarget("http://127.0.0.1:8080/").value(), expected);
    EXPECT_EQ(parseTarget("ws://127.0.0.1:8080").value(), expected);
}

TEST(Target, Port_Absent_IsTheSchemes) {
    EXPECT_EQ(parseTarget("ws://server").value().port, "80");
    EXPECT_EQ(parseTarget("wss://server").value().port, "443");
}

TEST(Target, Scheme_SaysWhetherTls) {
    for (const char* text : {"wss://a/ws", "https://a/"}) {
        EXPECT_TRUE(parseTarget(text).value().tls) << text;
    }
    for (const char* text : {"ws://a/ws", "http://a/"}) {
        EXPECT_FALSE(parseTarget(text).value().tls) << text;
    }
}

TEST(Target, Address_OfVersion6_LosesItsBrackets) {
    const Target target = parseTarget("ws://[::1]:9000/ws").value();
    EXPECT_EQ(target.host, "::1");
    EXPECT_EQ(target.authority, "[::1]:9000");
}

TEST(Target, Url_NotOne_IsRefusedWithItsText) {
    for (const char* text : {"", "127.0.0.1:8080", "ftp://a/", "ws://", "ws:///ws", "ws://user@a/",
                             "ws://a:0/", "ws://a:65536/", "ws://a:x/", "ws://a b/", "wss://.a/",
                             "wss://a%00b/", "ws://a/#part", "ws://[::1/"}) {
        const auto target = parseTarget(text);
        ASSERT_FALSE(target) << text;
        EXPECT_EQ(target.error().code, ErrorCode::kInvalidArgument);
        EXPECT_NE(target.error().message.find(std::string("'") + text + "'"), std::string::npos)
            << target.error().message;
    }
}

} // namespace
} // namespace froxel::load

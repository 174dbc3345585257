#include "net/request_form.h"

#include <gtest/gtest.h>

namespace froxel::net {
namespace {

namespace http = boost::beast::http;

Request get(std::string_view target) {
    Request request(http::verb::get, boost::beast::string_view(target.data(), target.size()), 11);
    request.set(http::field::host, "froxel.example");
    return request;
}

TEST(RequestForm, ListsOnSeveralLines_AreOne) {
    Request request = get("/ws");
    request.insert("Sec-WebSocket-Protocol", "chat");
    request.insert("sec-websocket-protocol", "froxel.v1");
    request.insert("Connection", "keep-alive");
    request.insert("Connection", "Upgrade");
    request.insert("X-Forwarded-Proto", "https");
    ASSERT_TRUE(settleForm(request));
    EXPECT_EQ(request.count("Sec-WebSocket-Protocol"), 1U);
    EXPECT_EQ(request["Sec-WebSocket-Protocol"], "chat, froxel.v1");
    EXPECT_EQ(request["Connection"], "keep-alive, Upgrade");
    EXPECT_EQ(request["X-Forwarded-Proto"], "https");
}

TEST(RequestForm, WhatHasOneValue_MustNotComeTwice) {
    for (const char* field : {"Host", "Origin"}) {
        Request request = get("/");
        request.insert("Origin", "https://a.example");
        request.insert(field, "b.example");
        const auto settled = settleForm(request);
        ASSERT_FALSE(settled) << field;
        EXPECT_EQ(settled.error().message,
                  std::string("the field ") + field + " came more than once");
    }
}

TEST(RequestForm, AbsoluteTarget_IsItsPathAndItsHost) {
    for (const auto& [target, path, host] :
         {std::tuple{"http://other.example/ws?room=a", "/ws?room=a", "other.example"},
          {"HTTPS://other.example:8443", "/", "other.example:8443"},
          {"http://[::1]:80/a%20b", "/a%20b", "[::1]:80"},
          {"http://other.example?x", "/?x", "other.example"}}) {
        Request request = get(target);
        ASSERT_TRUE(settleForm(request)) << target;
        EXPECT_EQ(request.target(), path);
        EXPECT_EQ(request["Host"], host);
    }
}

TEST(RequestForm, OtherTargets_StayOrAreRefused) {
    for (const char* target : {"/", "/a//b", "//evil.example/", "*"}) {
        Request request = get(target);
        ASSERT_TRUE(settleForm(request)) << target;
        EXPECT_EQ(request.target(), target);
        EXPECT_EQ(request["Host"], "froxel.example");
    }
    for (const char* target : {"ws", "?x", "http:/a", "http://", "http://user@a.example/",
                               "a.example:80", "http://a b/", "http://:80/"}) {
        Request request = get(target);
        EXPECT_FALSE(settleForm(request)) << target;
    }
}

TEST(RequestForm, WithoutHost_IsRefusedFromHttp11On) {
    Request request = get("/");
    request.erase("Host");
    ASSERT_FALSE(settleForm(request));
    EXPECT_EQ(settleForm(request).error().message, "the field Host is missing");
    request.version(10);
    EXPECT_TRUE(settleForm(request));
}

TEST(SettleForm, AnyTransferEncoding_IsRefused) {
    for (const char* coding : {"chunked", "gzip", "identity", "x, chunked"}) {
        Request request = get("/");
        request.set(boost::beast::http::field::transfer_encoding, coding);
        const auto settled = settleForm(request);
        ASSERT_FALSE(settled) << coding;
        EXPECT_EQ(settled.error().code, ErrorCode::kUnsupported);
    }
}

} // namespace
} // namespace froxel::net

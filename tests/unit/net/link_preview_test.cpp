#include "net/link_preview.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace froxel::net {
namespace {

namespace http = boost::beast::http;
using testing::HasSubstr;
using testing::Not;

Request asked(const std::string& target, const std::string& host = "froxel.example:8080") {
    Request request(http::verb::get, target, 11);
    request.set(http::field::host, host);
    return request;
}

TEST(LinkPreview, View_HasItsPicture_AndLeadsOn) {
    const Response page =
        linkPreview(asked("/view?renderer=naive&eye=1,2,3&size=640x480"), true, true);
    EXPECT_EQ(page.result(), http::status::ok);
    EXPECT_THAT(page.body(), HasSubstr(R"(<meta property="og:image" content=")"
                                       "https://froxel.example:8080/render?renderer=naive&amp;"
                                       R"(eye=1%2C2%2C3&amp;size=1200x630">)"));
    EXPECT_THAT(page.body(), HasSubstr(R"(<a href="./#renderer=naive&amp;eye=1%2C2%2C3&amp;)"
                                       R"(size=640x480">)"));
    EXPECT_THAT(linkPreview(asked("/view"), false, true).body(),
                HasSubstr("\"http://froxel.example:8080/render?size=1200x630\""));
}

TEST(LinkPreview, Room_IsOfThePagesQuery) {
    const std::string page = linkPreview(asked("/view?room=us&lights=3"), false, true).body();
    EXPECT_THAT(page, HasSubstr(R"(href="./?room=us#lights=3")"));
    EXPECT_THAT(page, HasSubstr("/render?lights=3&amp;size"));
}

TEST(LinkPreview, ServerWithTokens_HasNoPicture) {
    EXPECT_THAT(linkPreview(asked("/view?lights=3"), true, false).body(),
                Not(HasSubstr("og:image")));
}

TEST(LinkPreview, WhateverIsAsked_IsNoMarkup) {
    const std::string query =
        "/view?scene=%22%3E%3Cscript%3E&room=%22%3E%3Cscript%3E&%3Cscript%3E='><script>";
    for (const std::string host : {"a\"><script>", "a'b", "", "a<b"}) {
        const std::string page = linkPreview(asked(query, host), false, true).body();
        EXPECT_THAT(page, Not(HasSubstr("<script"))) << host;
        EXPECT_THAT(page, Not(HasSubstr("\"><s"))) << host;
    }
}

} // namespace
} // namespace froxel::net

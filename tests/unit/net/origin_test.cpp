#include "net/origin.h"

#include <gtest/gtest.h>

#include <vector>

namespace froxel::net {
namespace {

TEST(OriginAllowed, NoOrigin_IsAllowed) {
    EXPECT_TRUE(originAllowed({}, "host:8080", false, {}));
}

TEST(OriginAllowed, SameHost_IsAllowedInAnyCase) {
    EXPECT_TRUE(originAllowed("http://host:8080", "host:8080", false, {}));
    EXPECT_TRUE(originAllowed("https://host", "host", false, {}));
    EXPECT_TRUE(originAllowed("HTTP://Host:8080", "hOST:8080", false, {}));
    EXPECT_TRUE(originAllowed("http://[::1]:8080", "[::1]:8080", false, {}));
}

TEST(OriginAllowed, AnotherHost_IsRefused) {
    for (const char* foreign :
         {"http://evil", "http://host:8081", "http://host:8080.evil", "http://evilhost:8080",
          "http://host:8080/", "http://user@host:8080", "host:8080", "ftp://host:8080", "null", "",
          "http://"}) {
        EXPECT_FALSE(originAllowed(foreign, "host:8080", false, {})) << foreign;
    }
}

TEST(OriginAllowed, OwnPageWithoutTls_MayNotConnectWithIt) {
    EXPECT_TRUE(originAllowed("https://host", "host", true, {}));
    EXPECT_FALSE(originAllowed("http://host", "host", true, {}));
}

// nginx's $host:$server_port, and names with the root's dot.
TEST(OriginAllowed, SameHostInAnotherSpelling_IsAllowed) {
    EXPECT_TRUE(originAllowed("https://example.com", "example.com:443", true, {}));
    EXPECT_TRUE(originAllowed("https://example.com:443", "example.com", true, {}));
    EXPECT_TRUE(originAllowed("http://example.com", "example.com:80", false, {}));
    EXPECT_TRUE(originAllowed("http://example.com.:8080", "EXAMPLE.com:8080", false, {}));
    EXPECT_TRUE(originAllowed("https://example.com", "example.com.", true, {}));
    EXPECT_TRUE(originAllowed("http://[0:0::1]:8080", "[::1]:8080", false, {}));
}

TEST(OriginAllowed, PortOfTheOtherScheme_IsRefused) {
    EXPECT_FALSE(originAllowed("https://example.com", "example.com:80", false, {}));
    EXPECT_FALSE(originAllowed("http://example.com", "example.com:443", false, {}));
    EXPECT_FALSE(originAllowed("http://example.com:0", "example.com:0", false, {}));
    EXPECT_FALSE(originAllowed("http://example.com:65616", "example.com:80", false, {}));
    EXPECT_FALSE(originAllowed("http://example.com..", "example.com", false, {}));
}

TEST(OriginAllowed, EmptyHost_MatchesNothing) {
    EXPECT_FALSE(originAllowed("http://", "", false, {}));
}

TEST(OriginAllowed, Listed_IsAllowedExactly) {
    const std::vector<std::string> listed = {"https://gallery.example"};
    EXPECT_TRUE(originAllowed("https://gallery.example", "host", false, listed));
    EXPECT_TRUE(originAllowed("https://Gallery.example.:443", "host", false, listed));
    EXPECT_FALSE(originAllowed("http://gallery.example", "host", false, listed));
    EXPECT_FALSE(originAllowed("https://gallery.example:444", "host", false, listed));
}

TEST(FetchOf, ByFetchMetadataAndThePagesOrigin) {
    const std::vector<std::string> allowed = {"https://gallery.example"};
    const auto of = [&](const FetchedBy& by) { return fetchOf(by, "froxel.example", allowed); };
    EXPECT_EQ(of({}), Fetch::kOwn) << "a program";
    EXPECT_EQ(of({.site = "same-origin"}), Fetch::kOwn);
    EXPECT_EQ(of({.site = "none"}), Fetch::kOwn) << "an address that a person has entered";
    EXPECT_EQ(of({.site = "cross-site", .mode = "navigate", .dest = "document"}), Fetch::kOwn)
        << "a link that a person follows";
    EXPECT_EQ(of({.site = "cross-site", .mode = "navigate", .dest = "iframe"}), Fetch::kForeign);
    EXPECT_EQ(of({.site = "cross-site", .mode = "no-cors", .dest = "image"}), Fetch::kForeign);
    EXPECT_EQ(of({.site = "same-site", .mode = "no-cors", .referer = "http://froxel.example:81/"}),
              Fetch::kForeign)
        << "another port of this host";
    EXPECT_EQ(of({.site = "cross-site", .referer = "https://gallery.example/all?x#y"}),
              Fetch::kAllowed);
    EXPECT_EQ(of({.site = "cross-site", .origin = "https://gallery.example"}), Fetch::kAllowed);
    EXPECT_EQ(of({.site = "cross-site",
                  .origin = "https://evil.example",
                  .referer = "https://gallery.example/"}),
              Fetch::kForeign);
    EXPECT_EQ(of({.site = "cross-site", .referer = "about:blank"}), Fetch::kForeign);
    EXPECT_EQ(of({.origin = "http://froxel.example"}), Fetch::kOwn) << "an old browser";
    EXPECT_EQ(of({.origin = "null"}), Fetch::kForeign);
}

} // namespace
} // namespace froxel::net

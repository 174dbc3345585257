#include "net/http_routes.h"

#include <gtest/gtest.h>

namespace froxel::net {
namespace {

namespace http = boost::beast::http;

Request request(http::verb verb, std::string_view target) {
    return Request(verb, boost::beast::string_view(target.data(), target.size()), 11);
}

TEST(PathOf, Query_IsCutOff) {
    EXPECT_EQ(pathOf(request(http::verb::get, "/a/b?c=/d?e")), "/a/b");
    EXPECT_EQ(pathOf(request(http::verb::get, "/")), "/");
    EXPECT_EQ(pathOf(request(http::verb::get, "?x")), "");
}

TEST(Respond, PageIsNotBuilt_SaysHowToBuildIt) {
    const auto response = respond(request(http::verb::get, "/"), {}, {});
    EXPECT_EQ(response.result(), http::status::not_found);
    EXPECT_NE(response.body().find("build.sh"), std::string::npos);
}

TEST(Respond, Health_FollowsTheService) {
    ServiceStatus status;
    const auto health = [&] { return respond(request(http::verb::get, "/healthz"), {}, status); };
    EXPECT_EQ(health().body(), R"({"status":"loading"})");
    status.serving = Serving{};
    EXPECT_EQ(health().body(), R"({"status":"serving"})");
    status.draining = std::chrono::milliseconds(1);
    EXPECT_EQ(health().result(), http::status::service_unavailable);
}

TEST(Respond, EveryAnswer_HasTheSecurityHeaders) {
    for (const char* target : {"/", "/healthz", "/ws", "/nothing"}) {
        const auto response = respond(request(http::verb::get, target), {}, {});
        EXPECT_EQ(response["X-Content-Type-Options"], "nosniff") << target;
        EXPECT_NE(response["Content-Security-Policy"].find("frame-ancestors 'none'"),
                  std::string_view::npos)
            << target;
    }
}

TEST(Refusal, Unavailable_SaysWhenToRetryAndCloses) {
    const auto response = refusal(http::status::service_unavailable, "full");
    EXPECT_EQ(response[http::field::retry_after], "5");
    EXPECT_FALSE(response.keep_alive());
}

} // namespace
} // namespace froxel::net

#include "net/http_routes.h"

#include <gtest/gtest.h>

namespace froxel::net {
namespace {

namespace http = boost::beast::http;

Request request(http::verb verb, std::string_view target) {
    return Request(verb, boost::beast::string_view(target.data(), target.size()), 11);
}

Site makeSite() {
    Site site;
    site.service = std::make_shared<Service>();
    site.metrics = std::make_shared<Metrics>();
    return site;
}

TEST(PathOf, Query_IsCutOff) {
    EXPECT_EQ(pathOf(request(http::verb::get, "/a/b?c=/d?e")), "/a/b");
    EXPECT_EQ(pathOf(request(http::verb::get, "/")), "/");
    EXPECT_EQ(pathOf(request(http::verb::get, "?x")), "");
}

TEST(Respond, PageIsNotBuilt_SaysHowToBuildIt) {
    const auto response = respond(request(http::verb::get, "/"), makeSite());
    EXPECT_EQ(response.result(), http::status::not_found);
    EXPECT_NE(response.body().find("build.sh"), std::string::npos);
}

TEST(Respond, Health_FollowsTheService) {
    const Site site = makeSite();
    const auto health = [&] { return respond(request(http::verb::get, "/healthz"), site); };
    EXPECT_EQ(health().body(), R"({"status":"loading"})");
    site.service->setServing({});
    EXPECT_EQ(health().body(), R"({"status":"serving"})");
    site.service->setDraining(std::chrono::milliseconds(1));
    EXPECT_EQ(health().result(), http::status::service_unavailable);
}

TEST(Respond, EveryAnswer_HasTheSecurityHeaders) {
    for (const char* target : {"/", "/healthz", "/metrics", "/ws", "/nothing"}) {
        const auto response = respond(request(http::verb::get, target), makeSite());
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

#include "net/admin_site.h"
#include "net/public_site.h"

#include <gtest/gtest.h>

namespace froxel::net {
namespace {

namespace http = boost::beast::http;

Request request(http::verb verb, std::string_view target) {
    return Request(verb, boost::beast::string_view(target.data(), target.size()), 11);
}

struct PublicSiteTest : testing::Test {
    PublicSiteTest() {
        auto parts = std::make_shared<Site>();
        parts->service = service;
        parts->metrics = std::make_shared<Metrics>();
        site.emplace(std::move(parts));
    }
    const std::shared_ptr<Service> service = std::make_shared<Service>();
    std::optional<PublicSite> site;
};

TEST(PathOf, Query_IsCutOff) {
    EXPECT_EQ(pathOf(request(http::verb::get, "/a/b?c=/d?e")), "/a/b");
    EXPECT_EQ(pathOf(request(http::verb::get, "/")), "/");
    EXPECT_EQ(pathOf(request(http::verb::get, "?x")), "");
}

TEST_F(PublicSiteTest, PageIsNotBuilt_SaysHowToBuildIt) {
    const auto response = respond(request(http::verb::get, "/"), *site);
    EXPECT_EQ(response.result(), http::status::not_found);
    EXPECT_NE(response.body().find("build.sh"), std::string::npos);
}

TEST_F(PublicSiteTest, Health_FollowsTheService) {
    const auto health = [&] { return respond(request(http::verb::get, "/healthz"), *site); };
    EXPECT_EQ(health().body(), R"({"status":"loading"})");
    service->setServing({});
    EXPECT_EQ(health().body(), R"({"status":"serving"})");
    service->setDraining({});
    EXPECT_EQ(health().result(), http::status::service_unavailable);
}

TEST_F(PublicSiteTest, Metrics_AreElsewhereAndItSaysWhere) {
    const auto response = respond(request(http::verb::get, "/metrics"), *site);
    EXPECT_EQ(response.result(), http::status::not_found);
    EXPECT_NE(response.body().find("--admin-bind"), std::string::npos) << response.body();
    EXPECT_EQ(response.body().find("froxel_"), std::string::npos);
}

TEST(AdminSite, Metrics_AreTheMetrics_AnythingElseIsNotFound) {
    auto metrics = std::make_shared<Metrics>();
    metrics->sessionOpened();
    const AdminSite site(metrics, std::make_shared<Service>(), {});
    const auto response = respond(request(http::verb::get, "/metrics?x=1"), site);
    EXPECT_EQ(response.result(), http::status::ok);
    EXPECT_EQ(response[http::field::content_type], Metrics::kContentType);
    EXPECT_NE(response.body().find("\nfroxel_viewers 1\n"), std::string::npos);
    for (const char* target : {"/", "/healthz", "/ws", "/metrics/", "//metrics", "/index.html"}) {
        EXPECT_EQ(respond(request(http::verb::get, target), site).result(), http::status::not_found)
            << target;
    }
}

TEST(AdminSite, Upgrade_Any_IsRefused) {
    const AdminSite site(std::make_shared<Metrics>(), std::make_shared<Service>(), {});
    EXPECT_TRUE(site.refuseUpgrade(request(http::verb::get, "/ws")));
}

TEST_F(PublicSiteTest, EveryAnswer_HasTheSecurityHeaders) {
    const AdminSite admin(std::make_shared<Metrics>(), std::make_shared<Service>(), {});
    const auto expectHeaders = [](const Response& response, const char* target) {
        EXPECT_EQ(response["X-Content-Type-Options"], "nosniff") << target;
        EXPECT_NE(response["Content-Security-Policy"].find("frame-ancestors 'none'"),
                  std::string_view::npos)
            << target;
    };
    for (const char* target : {"/", "/healthz", "/metrics", "/ws", "/nothing"}) {
        expectHeaders(respond(request(http::verb::get, target), *site), target);
        expectHeaders(respond(request(http::verb::get, target), admin), target);
    }
}

TEST(Refusal, Unavailable_SaysWhenToRetryAndCloses) {
    const auto response = refusal(http::status::service_unavailable, "full");
    EXPECT_EQ(response[http::field::retry_after], "5");
    EXPECT_FALSE(response.keep_alive());
}

} // namespace
} // namespace froxel::net

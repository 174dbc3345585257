#include "net/admin_site.h"
#include "net/public_site.h"
#include "session/resume_token.h"
#include "session/settings.h"
#include "support/fake_port.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace froxel::net {
namespace {

namespace http = boost::beast::http;

Request request(http::verb verb, std::string_view target) {
    return Request(verb, boost::beast::string_view(target.data(), target.size()), 11);
}

Request upgradeAt(std::string_view target) {
    Request upgrade = request(http::verb::get, target);
    upgrade.set(http::field::host, "froxel.example");
    upgrade.set(http::field::connection, "upgrade");
    upgrade.set(http::field::upgrade, "websocket");
    upgrade.set(http::field::sec_websocket_protocol, "froxel.v1");
    return upgrade;
}

struct PublicSiteTest : testing::Test {
    PublicSiteTest() {
        auto parts = std::make_shared<Site>();
        parts->service = service;
        parts->metrics = std::make_shared<Metrics>();
        parts->request_limits = std::make_shared<RequestLimits>();
        parts->lobby = lobby;
        parts->connections_per_address = 5;
        parts->trusted_proxies = TrustedProxies::parse({"10.0.0.0/8"}).value();
        site.emplace(std::move(parts));
    }
    test::FakePort port;
    const std::shared_ptr<Lobby> lobby =
        std::make_shared<Lobby>(LobbyRules{.resume_grace = std::chrono::seconds(10)});
    const std::shared_ptr<Service> service = std::make_shared<Service>();
    std::optional<PublicSite> site;
};

TEST_F(PublicSiteTest, SettingsJson_HasTheWordsOfEverySetting) {
    const Response answer =
        site->answer(request(http::verb::get, "/settings.json"), "/settings.json", {});
    EXPECT_EQ(answer.result(), http::status::ok);
    EXPECT_EQ(answer[http::field::content_type], "application/json");
    const auto words = nlohmann::json::parse(answer.body());
    ASSERT_EQ(words.size(), session::sessionSettings().size());
    for (size_t index = 0; index < words.size(); ++index) {
        EXPECT_EQ(words[index].at("name"), session::sessionSettings()[index].facts().name);
        EXPECT_FALSE(words[index].at("help").get<std::string>().empty());
    }
}

TEST_F(PublicSiteTest, Upgrade_OfWhoWouldGetNoPlace_Is503WithRetryAfter) {
    service->setServing({std::make_shared<const session::SessionContext>(), &port});
    const auto ask = [&](std::string_view target) {
        return site->refuseUpgrade(upgradeAt(target), {});
    };
    EXPECT_FALSE(ask("/ws"));
    const auto seat = lobby->enter(service->status().serving.value(), {1, 0, "", "hall", ""}, {},
                                   {}, Clock::now());
    port.full = true;
    for (const char* newcomer : {"/ws", "/ws?room=cellar", "/ws?resume=0123456789abcdef",
                                 "/ws?room=%FF&resume", "/ws?resume=", "/ws?room=hall&resume=0"}) {
        const auto refused = ask(newcomer);
        ASSERT_TRUE(refused) << newcomer;
        EXPECT_EQ(refused->result(), http::status::service_unavailable);
        EXPECT_EQ((*refused)[http::field::retry_after], "5");
    }
    EXPECT_FALSE(ask("/ws?room=hall"));
    const std::string name(session::resumeName(seat->resume_token));
    EXPECT_FALSE(ask("/ws?resume=" + name));
}

TEST_F(PublicSiteTest, ManyConnections_OfOneAddressAreLimited_ButNotOfProxies) {
    const auto most = [&](const char* peer) {
        return site->connectionsMax(boost::asio::ip::make_address(peer));
    };
    EXPECT_EQ(most("192.0.2.7"), 5U);
    EXPECT_GT(most("127.0.0.1"), 1'000'000U);
    EXPECT_GT(most("10.1.2.3"), 1'000'000U);
}

TEST_F(PublicSiteTest, ManyRequests_OfOneAddressHaveToWait_ButNotOnThisMachine) {
    const Request asked = request(http::verb::get, "/");
    const auto wait = [&](const char* peer) {
        return site->waitOf(asked, boost::asio::ip::make_address(peer)).count();
    };
    double most = 0;
    for (int i = 0; i < 2 * static_cast<int>(RequestLimits::kAtOnce); ++i) {
        most = std::max(most, wait("192.0.2.7"));
        EXPECT_EQ(wait("127.0.0.1"), 0);
    }
    EXPECT_GT(most, 0);
    EXPECT_EQ(wait("192.0.2.8"), 0) << "another's";
}

TEST(RequestLimits, WrongTokens_AreWaitedForSooner) {
    RequestLimits limits;
    const session::Account guesser{"192.0.2.7"};
    const TimePoint now{};
    int guesses = 0;
    while (limits.ask(guesser, now) == Seconds(0)) {
        limits.onWrongToken(guesser, now);
        ++guesses;
    }
    EXPECT_LT(guesses, 50);
    const Seconds wait = limits.ask(guesser, now);
    EXPECT_GT(wait.count(), 0);
    EXPECT_EQ(limits.ask(guesser, now + std::chrono::seconds(1)), Seconds(0));
}

TEST_F(PublicSiteTest, PagesOfOtherSites_HaveNothingDrawn) {
    Request still = request(http::verb::get, "/render?scene=x");
    still.set(http::field::host, "localhost:8080");
    still.set("Sec-Fetch-Site", "cross-site");
    still.set("Sec-Fetch-Mode", "no-cors");
    still.set("Sec-Fetch-Dest", "image");
    // Thumbnails are below the path of the scenes' list, and are drawn.
    const std::string thumbnail = "/api/v1/scenes/x" + std::string(kThumbnail);
    for (const std::string& path : {std::string("/render"), thumbnail}) {
        std::optional<LateAnswer> answer;
        const auto call_off = site->answerLater(still, path, boost::asio::ip::address(),
                                                [&](LateAnswer came) { answer = std::move(came); });
        EXPECT_TRUE(call_off) << path;
        ASSERT_TRUE(answer) << path;
        EXPECT_EQ(answer->response.result(), http::status::forbidden);
    }
    EXPECT_EQ(site->answer(still, "/api/v1/scenes", {}).result(), http::status::forbidden);
}

TEST(AdminSite, TakeControl_ByPostOfARoomsName_AndOfNoBrowser) {
    std::vector<std::string> asked;
    AdminHooks hooks;
    hooks.take_control = [&](const std::string& room) {
        asked.push_back(room);
        return room == "hall";
    };
    const AdminSite site(std::make_shared<Metrics>(), std::make_shared<Service>(), hooks);
    const auto post = [&](std::string_view target) {
        return respond(request(http::verb::post, target), site, {}).result();
    };
    EXPECT_EQ(post("/rooms/hall/take-control"), http::status::ok);
    EXPECT_EQ(post("/rooms/cellar/take-control"), http::status::not_found);
    EXPECT_EQ(asked, (std::vector<std::string>{"hall", "cellar"}));
    for (const char* other : {"/rooms//take-control", "/rooms/a%20b/take-control",
                              "/rooms/take-control", "/rooms/hall", "/rooms/hall/take-control/"}) {
        EXPECT_EQ(post(other), http::status::method_not_allowed) << other;
    }
    Request foreign = request(http::verb::post, "/rooms/hall/take-control");
    foreign.set(http::field::origin, "https://evil.example");
    EXPECT_EQ(respond(foreign, site, {}).result(), http::status::forbidden);
    EXPECT_EQ(asked.size(), 2U);
}

TEST(PathOf, Query_IsCutOff) {
    EXPECT_EQ(pathOf(request(http::verb::get, "/a/b?c=/d?e")), "/a/b");
    EXPECT_EQ(pathOf(request(http::verb::get, "/")), "/");
    EXPECT_EQ(pathOf(request(http::verb::get, "?x")), "");
}

TEST_F(PublicSiteTest, PageIsNotBuilt_SaysHowToBuildIt) {
    const auto response = respond(request(http::verb::get, "/"), *site, {});
    EXPECT_EQ(response.result(), http::status::not_found);
    EXPECT_NE(response.body().find("build.sh"), std::string::npos);
}

TEST_F(PublicSiteTest, Health_FollowsTheService) {
    const auto health = [&] { return respond(request(http::verb::get, "/healthz"), *site, {}); };
    EXPECT_EQ(health().body(), R"({"status":"loading"})");
    service->setServing({});
    EXPECT_EQ(health().body(), R"({"status":"serving"})");
    service->setDraining({});
    EXPECT_EQ(health().result(), http::status::service_unavailable);
}

TEST_F(PublicSiteTest, Metrics_AreElsewhereAndItSaysWhere) {
    const auto response = respond(request(http::verb::get, "/metrics"), *site, {});
    EXPECT_EQ(response.result(), http::status::not_found);
    EXPECT_NE(response.body().find("--admin-bind"), std::string::npos) << response.body();
    EXPECT_EQ(response.body().find("froxel_"), std::string::npos);
}

TEST(AdminSite, Metrics_AreTheMetrics_AnythingElseIsNotFound) {
    auto metrics = std::make_shared<Metrics>();
    metrics->sessionOpened();
    const AdminSite site(metrics, std::make_shared<Service>(), {});
    const auto response = respond(request(http::verb::get, "/metrics?x=1"), site, {});
    EXPECT_EQ(response.result(), http::status::ok);
    EXPECT_EQ(response[http::field::content_type], Metrics::kContentType);
    EXPECT_NE(response.body().find("\nfroxel_viewers 1\n"), std::string::npos);
    for (const char* target : {"/", "/healthz", "/ws", "/metrics/", "//metrics", "/index.html"}) {
        EXPECT_EQ(respond(request(http::verb::get, target), site, {}).result(),
                  http::status::not_found)
            << target;
    }
}

TEST(AdminSite, Upgrade_Any_IsRefused) {
    const AdminSite site(std::make_shared<Metrics>(), std::make_shared<Service>(), {});
    EXPECT_TRUE(site.refuseUpgrade(request(http::verb::get, "/ws"), {}));
}

TEST_F(PublicSiteTest, Upgrade_SubprotocolIsNotOffered_IsRefused) {
    Request upgrade = upgradeAt("/ws");
    EXPECT_FALSE(site->refuseUpgrade(upgrade, {}));
    upgrade.erase(http::field::sec_websocket_protocol);
    EXPECT_EQ(site->refuseUpgrade(upgrade, {})->result(), http::status::bad_request);
}

TEST_F(PublicSiteTest, Upgrade_ProxyHasTls_WantsThePageToHaveIt) {
    Request upgrade = upgradeAt("/ws");
    upgrade.set(http::field::origin, "http://froxel.example");
    EXPECT_FALSE(site->refuseUpgrade(upgrade, {}));
    upgrade.set("X-Forwarded-Proto", "https");
    EXPECT_EQ(site->refuseUpgrade(upgrade, {})->result(), http::status::forbidden);
}

TEST(RefuseHost, NameOfAnother_IsRefusedAtBothAddresses) {
    auto parts = std::make_shared<Site>();
    parts->host_names = HostNames({}, "127.0.0.1");
    const PublicSite open(parts);
    const AdminSite admin(std::make_shared<Metrics>(), std::make_shared<Service>(), {},
                          {HostNames({}, "127.0.0.1"), true, nullptr});
    Request rebound = request(http::verb::get, "/metrics");
    rebound.set(http::field::host, "evil.example:8080");
    Request own = request(http::verb::get, "/metrics");
    own.set(http::field::host, "127.0.0.1:8080");
    const auto expectOwnOnly = [&](const HttpSite& site) {
        EXPECT_EQ(refuseHost(rebound, site)->result(), http::status::misdirected_request);
        EXPECT_FALSE(refuseHost(own, site));
    };
    expectOwnOnly(open);
    expectOwnOnly(admin);
}

struct AdminDrain : testing::Test {
    http::status drain(AdminAccess access, const char* authorization = "") {
        Request post = request(http::verb::post, "/drain");
        post.set(http::field::authorization, authorization);
        const AdminSite site(std::make_shared<Metrics>(), std::make_shared<Service>(),
                             {[] { return true; }, [this] { ++drained; }}, std::move(access));
        return respond(post, site, {}).result();
    }
    int drained = 0;
};

TEST_F(AdminDrain, Loopback_NeedsNothing) {
    EXPECT_EQ(drain({}), http::status::accepted);
    EXPECT_EQ(drained, 1);
}

TEST_F(AdminDrain, BeyondLoopbackWithoutTokens_IsForbidden) {
    EXPECT_EQ(drain({{}, false, nullptr}), http::status::forbidden);
    EXPECT_EQ(drained, 0);
}

TEST_F(AdminDrain, WithTokens_OneIsAskedFor) {
    const std::filesystem::path file = testing::TempDir() + "froxel_admin_tokens";
    std::ofstream(file) << "a-token-0123456789\n";
    auto tokens = std::make_shared<TokenGate>();
    tokens->load(file).value();
    for (const bool loopback : {true, false}) {
        drained = 0;
        for (const char* wrong : {"", "Bearer another", "Bearer ", "a-token-0123456789"}) {
            EXPECT_EQ(drain({{}, loopback, tokens}, wrong), http::status::unauthorized) << wrong;
        }
        EXPECT_EQ(drained, 0);
        EXPECT_EQ(drain({{}, loopback, tokens}, "Bearer a-token-0123456789"),
                  http::status::accepted);
        EXPECT_EQ(drained, 1);
    }
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
        expectHeaders(respond(request(http::verb::get, target), *site, {}), target);
        expectHeaders(respond(request(http::verb::get, target), admin, {}), target);
    }
}

TEST(Refusal, Unavailable_SaysWhenToRetryAndCloses) {
    const auto response = refusal(http::status::service_unavailable, "full");
    EXPECT_EQ(response[http::field::retry_after], "5");
    EXPECT_FALSE(response.keep_alive());
}

} // namespace
} // namespace froxel::net

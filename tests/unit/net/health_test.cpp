#include "net/admin_site.h"
#include "net/health.h"
#include "support/fake_port.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <memory>

namespace froxel::net {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
namespace http = boost::beast::http;

class HealthTest : public testing::Test {
  protected:
    void serve() { service_->setServing({nullptr, &port_, heartbeat_, 30s}); }
    Response get(std::string_view path, http::verb verb = http::verb::get) {
        const Request request(verb, boost::beast::string_view(path.data(), path.size()), 11);
        return respond(request, site_, {});
    }
    void expectNo(std::string_view path, const char* why) {
        const Response response = get(path);
        EXPECT_EQ(response.result(), http::status::service_unavailable) << path;
        EXPECT_THAT(response.body(), HasSubstr(why)) << path;
    }
    void expectYes(std::string_view path) {
        EXPECT_EQ(get(path).result(), http::status::ok) << path << " " << get(path).body();
    }

    test::FakePort port_;
    bool network_moves_ = true;
    int drains_ = 0;
    std::shared_ptr<Heartbeat> heartbeat_ = std::make_shared<Heartbeat>();
    std::shared_ptr<Service> service_ = std::make_shared<Service>();
    AdminSite site_{std::make_shared<Metrics>(), service_,
                    AdminHooks{[this] { return network_moves_; }, [this] { ++drains_; }}};
};

TEST_F(HealthTest, Loading_IsLiveAndSaysHowFarItIs) {
    service_->setLoading({"loading the scene", 0.25});
    expectYes(kLivePath);
    expectNo(kStartedPath, "loading the scene, 25 %");
    expectNo(kReadyPath, "loading the scene, 25 %");
}

TEST_F(HealthTest, Serving_IsWell_UntilDraining) {
    serve();
    for (const auto path : {kLivePath, kStartedPath, kReadyPath}) {
        expectYes(path);
    }
    service_->setDraining({});
    expectNo(kReadyPath, "draining");
    expectYes(kStartedPath);
    expectYes(kLivePath);
}

TEST_F(HealthTest, DeviceLost_IsNeitherLiveNorReady) {
    serve();
    service_->setLost("the device did not finish");
    expectNo(kLivePath, "did not finish");
    expectNo(kReadyPath, "did not finish");
}

TEST_F(HealthTest, Full_IsReady) {
    serve();
    port_.full = true;
    expectYes(kReadyPath);
}

TEST_F(HealthTest, RenderThreadAtOneStep_IsUnreadyFirstAndDeadLater) {
    serve();
    heartbeat_->beat(Clock::now() - 11s);
    expectNo(kReadyPath, "the render thread has spent 11");
    expectYes(kLivePath);
    heartbeat_->beat(Clock::now() - 31s);
    expectNo(kLivePath, "the limit is 30 s");
    heartbeat_->rest();
    expectYes(kReadyPath);
    expectYes(kLivePath);
}

TEST_F(HealthTest, NetworkStandsStill_IsDead) {
    network_moves_ = false;
    expectNo(kLivePath, "network threads");
}

TEST_F(HealthTest, Drain_ByPostOnly) {
    EXPECT_EQ(get(kDrainPath).result(), http::status::method_not_allowed);
    EXPECT_EQ(get(kMetricsPath, http::verb::post).result(), http::status::method_not_allowed);
    EXPECT_EQ(drains_, 0);
    EXPECT_EQ(get(kDrainPath, http::verb::post).result(), http::status::accepted);
    EXPECT_EQ(drains_, 1);
}

} // namespace
} // namespace froxel::net

// When Agones' SDK is told what. No sockets, no clock.
#include "net/agones_plan.h"

#include <gtest/gtest.h>

#include <vector>

namespace froxel::net {
namespace {

using namespace std::chrono_literals;

constexpr const char* kFull = R"({"count":"3","capacity":"8"})";

class AgonesPlanTest : public testing::Test {
  protected:
    // What is said now, each accepted; a path, or the counter's body.
    std::vector<std::string> said() {
        std::vector<std::string> all;
        while (const auto call = plan_.next(news_, now_)) {
            all.emplace_back(call->topic == AgonesTopic::kCounter ? call->body : call->path);
            plan_.onAccepted(*call, now_);
        }
        return all;
    }
    // All that is due fails; how often something was.
    size_t failures() {
        size_t count = 0;
        for (; const auto call = plan_.next(news_, now_); ++count) {
            plan_.onFailed(*call, now_);
        }
        return count;
    }
    using Said = std::vector<std::string>;

    AgonesPlan plan_{8};
    AgonesNews news_;
    TimePoint now_{100s};
};

TEST_F(AgonesPlanTest, Loading_SaysHealthAlone) {
    EXPECT_EQ(said(), Said{"/health"});
    EXPECT_EQ(said(), Said{});
    now_ += 2s;
    EXPECT_EQ(said(), Said{"/health"});
}

TEST_F(AgonesPlanTest, Started_SaysReadyOnce_EvenWhereViewersAreAlreadyThere) {
    news_ = {.started = true, .sessions = 3};
    EXPECT_EQ(said(), (Said{"/ready", "/allocate", "/health", kFull}));
    EXPECT_EQ(said(), Said{});
}

TEST_F(AgonesPlanTest, LastViewerGoes_IsReadyAgain_ButNotWhileItDrains) {
    news_ = {.started = true, .sessions = 1};
    said();
    news_.sessions = 0;
    EXPECT_EQ(said(), (Said{"/ready", R"({"count":"0","capacity":"8"})"}));
    news_.sessions = 1;
    said();
    news_.draining = true;
    EXPECT_EQ(said(), Said{R"({"count":"1","capacity":"1"})"});
    news_.sessions = 0;
    EXPECT_EQ(said(), Said{R"({"count":"0","capacity":"0"})"});
    news_.over = true;
    EXPECT_EQ(said(), Said{"/shutdown"});
    now_ += 60s;
    EXPECT_EQ(said(), Said{}) << "nothing after it";
}

TEST_F(AgonesPlanTest, OverWhileLoading_SaysShutdown) {
    news_.over = true;
    EXPECT_EQ(said(), Said{"/shutdown"});
}

TEST_F(AgonesPlanTest, Failures_AreTriedAgainEverLater_EachTopicByItself) {
    news_ = {.started = true, .sessions = 3};
    EXPECT_EQ(failures(), 3U) << "health, state, counter";
    EXPECT_EQ(failures(), 0U);
    std::vector<Seconds> gaps;
    for (int i = 0; i < 7; ++i) {
        const TimePoint failed = now_;
        while (failures() == 0) {
            now_ += 100ms;
        }
        gaps.emplace_back(now_ - failed);
    }
    EXPECT_EQ(gaps, (std::vector<Seconds>{0.5s, 1s, 2s, 4s, 8s, 10s, 10s}));
    now_ += 10s;
    EXPECT_EQ(said().size(), 4U);
    news_.sessions = 4;
    EXPECT_EQ(failures(), 1U);
    now_ += 500ms;
    EXPECT_EQ(failures(), 1U) << "what was accepted begins anew";
}

TEST_F(AgonesPlanTest, RetryNow_ForgetsTheWait) {
    news_ = {.started = true};
    EXPECT_GT(failures(), 0U);
    news_.over = true;
    EXPECT_EQ(said(), Said{});
    EXPECT_FALSE(plan_.saidEnd());
    plan_.retryNow();
    EXPECT_EQ(said(), Said{"/shutdown"});
    EXPECT_TRUE(plan_.saidEnd());
}

TEST_F(AgonesPlanTest, SkippedHealth_IsDueAPeriodLater_AndHoldsNothingUp) {
    news_.started = true;
    plan_.skipHealth(now_);
    EXPECT_EQ(said(), (Said{"/ready", R"({"count":"0","capacity":"8"})"}));
    now_ += 2s;
    EXPECT_EQ(said(), Said{"/health"});
}

} // namespace
} // namespace froxel::net

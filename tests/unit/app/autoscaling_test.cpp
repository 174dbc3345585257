// Admission, the metric and the autoscaler's manifest together: whether servers are added before
// viewers are sent away. The autoscaler's formula is from Kubernetes' documentation of the
// HorizontalPodAutoscaler: replicas x metric / target, rounded up, within a tolerance of 0.1.
#include "net/metrics.h"
#include "stream/admission.h"
#include "support/places.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>
#include <vector>

namespace froxel::app {
namespace {

using namespace std::chrono_literals;

// Of the metric in the manifest, which is in thousandths there.
double targetOf(const std::string& metric) {
    std::ifstream file(
        test::repositoryPath("deploy/kubernetes/components/autoscaler/autoscaler.yaml"));
    std::ostringstream text;
    text << file.rdbuf();
    const std::regex row("name: " + metric +
                         "\\s+target:\\s+type: AverageValue\\s+"
                         "averageValue: \"?([0-9]+)m\"?\\s");
    std::smatch found;
    const std::string content = text.str();
    return std::regex_search(content, found, row) ? std::stod(found[1]) / 1000 : 0;
}

// A server whose viewers move, each drawn as fast as all together get on.
class Pod {
  public:
    explicit Pod(Seconds frame_cost) : cost_(frame_cost) {
        admission_.setMinRate(5, cost_);
        metrics_.watchLoad([this] { return admission_.load(now_); });
    }
    [[nodiscard]] bool full() const { return !admission_.check({"newcomer"}, now_); }
    void join() {
        ++viewers_;
        admission_.add(viewers_, {"viewer " + std::to_string(viewers_)}, now_);
        const auto round = std::chrono::duration_cast<Clock::duration>(
            std::max(viewers_ * cost_, Seconds(1.0 / 60)));
        for (const TimePoint end = now_ + 5s; now_ < end; now_ += round) {
            for (uint64_t viewer = 1; viewer <= viewers_; ++viewer) {
                admission_.onFrame(viewer, cost_, now_);
            }
        }
    }
    // As Prometheus gets it.
    [[nodiscard]] double served() const {
        const std::string text = metrics_.text();
        const std::string name = "\nfroxel_device_load ";
        return std::stod(text.substr(text.find(name) + name.size()));
    }

  private:
    Seconds cost_;
    stream::Admission admission_;
    net::Metrics metrics_;
    uint64_t viewers_ = 0;
    TimePoint now_ = TimePoint() + 1h;
};

int desired(const std::vector<Pod*>& pods, double target) {
    double sum = 0;
    for (const Pod* pod : pods) {
        sum += pod->served();
    }
    const auto count = static_cast<double>(pods.size());
    const double ratio = sum / count / target;
    return static_cast<int>(std::abs(ratio - 1) <= 0.1 ? count : std::ceil(count * ratio));
}

class Autoscaling : public testing::Test {
  protected:
    const double target_ = targetOf("froxel_device_load");
};

TEST_F(Autoscaling, Manifest_HasATargetBelowFull) {
    EXPECT_GT(target_, 0.3);
    EXPECT_LT(target_, 0.9);
}

TEST_F(Autoscaling, NobodyMoves_NoServerIsAdded) {
    Pod a(60ms);
    Pod b(60ms);
    EXPECT_LE(desired({&a, &b}, target_), 2);
}

TEST_F(Autoscaling, OneMovingViewer_AddsNothing) {
    Pod a(60ms); // two cores, 640x360
    Pod b(60ms);
    a.join();
    EXPECT_LE(desired({&a, &b}, target_), 2);
}

// Whatever a frame costs: frames of 110 ms leave no room for a second viewer at the floor of 5.
TEST_F(Autoscaling, AllFull_MoreServersAreAskedFor) {
    for (const Seconds cost : {5ms, 20ms, 60ms, 110ms, 190ms, 400ms}) {
        Pod a(cost);
        Pod b(cost);
        while (!a.full()) {
            a.join();
            b.join();
            ASSERT_TRUE(a.full() || a.served() < 1) << cost.count();
        }
        EXPECT_EQ(a.served(), 1) << cost.count();
        EXPECT_GT(desired({&a, &b}, target_), 2) << cost.count();
    }
}

// With room for many, servers come before the last place is taken.
TEST_F(Autoscaling, CheapFrames_ServersAreAddedBeforeTheLastPlaceIsTaken) {
    Pod a(10ms);
    Pod b(10ms);
    int joined_after = 0;
    while (!a.full()) {
        joined_after += desired({&a, &b}, target_) > 2 ? 1 : 0;
        a.join();
        b.join();
    }
    EXPECT_GE(joined_after, 2);
}

} // namespace
} // namespace froxel::app

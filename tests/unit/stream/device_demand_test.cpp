// Moving viewers that share one device, and the resolution at which they keep their rates.
#include "session/rate_keeper.h"
#include "stream/device_demand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace froxel::stream {
namespace {

using namespace std::chrono_literals;

TimePoint at(Seconds time) {
    return TimePoint{} + std::chrono::duration_cast<Clock::duration>(time);
}

TEST(DeviceDemand, NobodyMoves_IsNone) {
    DeviceDemand demand;
    EXPECT_EQ(demand.total(at(0s)), 0);
    demand.onFrame(1, 10ms, 30, at(0s));
    EXPECT_EQ(demand.total(at(1.5s)), 0);
}

TEST(DeviceDemand, Targets_AddUp) {
    DeviceDemand demand;
    demand.onFrame(1, 10ms, 30, at(0s));
    demand.onFrame(2, 20ms, 60, at(0s));
    EXPECT_DOUBLE_EQ(demand.total(at(0.5s)), 1.5);
    demand.remove(2);
    EXPECT_DOUBLE_EQ(demand.total(at(0.5s)), 0.3);
}

TEST(DeviceDemand, WithoutTarget_CountsAsItsFairShare) {
    DeviceDemand demand;
    demand.onFrame(1, 500ms, 0, at(0s));
    EXPECT_DOUBLE_EQ(demand.total(at(0s)), 1);
    demand.onFrame(2, 10ms, 30, at(0s));
    EXPECT_DOUBLE_EQ(demand.total(at(0s)), 0.5 + 0.3);
}

// Viewers in turn on a device where a part of each frame goes with its area.
class SharedDevice {
  public:
    explicit SharedDevice(size_t count) : keepers_(count) {
        for (auto& keeper : keepers_) {
            keeper.setTarget(kTarget_hz, false);
        }
    }
    // Frames a second of each viewer over this time.
    double run(Seconds time) {
        const Seconds end = now_ + time;
        uint64_t frames = 0;
        seen_.clear();
        while (now_ < end) {
            const Seconds begin = now_;
            for (size_t i = 0; i < keepers_.size(); ++i) {
                const double scale = keepers_[i].relief().scale;
                const Seconds cost = kFixed + kFull * (scale * scale);
                now_ += cost;
                demand_.onFrame(i, cost, kTarget_hz, at(now_));
                const Seconds shared(demand_.total(at(now_)) / kTarget_hz);
                keepers_[i].onFrame(std::max(cost, shared), {scale, 0}, at(now_));
                seen_.insert(keepers_[i].relief().scale);
                ++frames;
            }
            now_ = std::max(now_, begin + Seconds(1.0 / 60)); // no viewer's pace is faster
        }
        return static_cast<double>(frames) / static_cast<double>(keepers_.size()) / time.count();
    }
    [[nodiscard]] const std::set<double>& seen() const { return seen_; }

    static constexpr double kTarget_hz = 30;

  private:
    static constexpr Seconds kFixed{0.0002};
    static constexpr Seconds kFull{0.0005};
    std::vector<session::RateKeeper> keepers_;
    DeviceDemand demand_;
    Seconds now_{1};
    std::set<double> seen_;
};

TEST(DeviceDemand, FewViewers_KeepTheFullSize) {
    SharedDevice device(20);
    EXPECT_GT(device.run(10s), 30);
    EXPECT_EQ(device.seen(), std::set{1.0});
}

TEST(DeviceDemand, ManyViewers_ShrinkUntilTheyKeepTheirRateAndStayThere) {
    SharedDevice device(80); // 56 ms a turn at full size, 33 allowed
    device.run(5s);
    EXPECT_GT(device.run(10s), 0.95 * SharedDevice::kTarget_hz);
    EXPECT_LE(device.seen().size(), 2U); // at most a step up that is tried and taken back
    EXPECT_LT(*device.seen().begin(), 1);
    EXPECT_GT(*device.seen().begin(), 0.4);
}

} // namespace
} // namespace froxel::stream

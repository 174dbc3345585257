#include "session/rate_keeper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace froxel::session {
namespace {

using namespace std::chrono_literals;

// Of a scene without coarser levels.
Relief plain(double scale) {
    return {scale, 0};
}

// A renderer whose frames cost a part that stays and one that goes with the area.
class Renderer {
  public:
    void run(RateKeeper& keeper, Seconds full, Seconds time) {
        for (const Seconds end = now_ + time; now_ < end;) {
            const double side = keeper.relief().scale;
            const Seconds cost = 0.2 * full + 0.8 * full * (side * side);
            now_ += cost;
            keeper.onFrame(cost, plain(side),
                           TimePoint(10s) + std::chrono::duration_cast<Clock::duration>(now_));
            moves_ += keeper.relief().scale != side ? 1 : 0;
            last_cost_ = cost;
        }
    }
    [[nodiscard]] Seconds lastCost() const { return last_cost_; }
    int takeMoves() { return std::exchange(moves_, 0); }

  private:
    Seconds now_{0};
    Seconds last_cost_{0};
    int moves_ = 0;
};

TEST(RateKeeper, NoTarget_StaysFull) {
    RateKeeper keeper;
    Renderer().run(keeper, 500ms, 20s);
    EXPECT_EQ(keeper.relief().scale, 1);
}

TEST(RateKeeper, CostStep_IsFollowedAndTakenBack) {
    RateKeeper keeper;
    keeper.setTarget(15, false);
    Renderer renderer;
    renderer.run(keeper, 50ms, 5s);
    EXPECT_EQ(keeper.relief().scale, 1);
    renderer.run(keeper, 120ms, 1s);
    EXPECT_LT(renderer.lastCost(), Seconds(1.0 / 15 * 1.05));
    EXPECT_LT(keeper.relief().scale, 1);
    renderer.run(keeper, 120ms, 30s);
    renderer.takeMoves();
    renderer.run(keeper, 120ms, 60s);
    EXPECT_LE(renderer.takeMoves(), 2) << "it settles";
    renderer.run(keeper, 50ms, 10s);
    EXPECT_EQ(keeper.relief().scale, 1);
}

// Smaller pictures are cheap, and the whole one is not: ever longer until it is tried again.
TEST(RateKeeper, AStepThatIsTakenBack_IsHeldLongerEachTime) {
    RateKeeper keeper;
    keeper.setTarget(15, false);
    TimePoint now(10s);
    std::vector<TimePoint> tried;
    while (now < TimePoint(200s)) {
        const double at = keeper.relief().scale;
        const auto cost = at == 1 ? 100ms : 20ms;
        now += cost;
        keeper.onFrame(cost, plain(at), now);
        if (keeper.relief().scale == 1 && at != 1) {
            tried.push_back(now);
        }
    }
    ASSERT_GE(tried.size(), 6U);
    EXPECT_LE(tried.size(), 10U);
    EXPECT_GT(tried[5] - tried[4], 1.5 * (tried[4] - tried[3]));
    EXPECT_NEAR(Seconds(tried.back() - tried.end()[-2]).count(), 60, 2) << "30 s a step at most";
}

TEST(RateKeeper, NotToBeReached_StopsAtTheSmallest) {
    RateKeeper keeper;
    keeper.setTarget(60, false);
    Renderer().run(keeper, 800ms, 10s);
    EXPECT_EQ(keeper.relief().scale, RateKeeper::kScales.back());
    keeper.setTarget(0, false);
    EXPECT_EQ(keeper.relief().scale, 1);
}

// Frames of a scene with coarser levels: by the scale's area, and by what each error leaves.
using Shares = std::array<double, RateKeeper::kErrors_px.size()>;

struct Drawn {
    Relief relief; // at last
    int moves = 0;
};

Drawn draw(
    RateKeeper& keeper, Seconds full, const Shares& shares, Seconds time, Seconds from = 0s) {
    Drawn drawn;
    for (Seconds now = from; now < from + time;) {
        const Relief with = keeper.relief();
        const auto error = std::ranges::find(RateKeeper::kErrors_px, with.geometry_error_px);
        const Seconds cost = full *
                             shares[static_cast<size_t>(error - RateKeeper::kErrors_px.begin())] *
                             (0.2 + 0.8 * with.scale * with.scale);
        now += cost;
        keeper.onFrame(cost, with,
                       TimePoint(10s) + std::chrono::duration_cast<Clock::duration>(now));
        drawn.relief = keeper.relief();
        drawn.moves += drawn.relief == with ? 0 : 1;
    }
    return drawn;
}

constexpr Shares kGeometryBound = {1, 0.75, 0.5, 0.3};

TEST(RateKeeper, CoarserLevels_GiveTheSmallestErrorThatFits) {
    RateKeeper keeper;
    keeper.setTarget(15, true);
    EXPECT_EQ(draw(keeper, 50ms, kGeometryBound, 5s).relief, Relief());
    EXPECT_EQ(draw(keeper, 80ms, kGeometryBound, 5s, 5s).relief, Relief(1, 0.5));
    EXPECT_EQ(draw(keeper, 120ms, kGeometryBound, 30s, 10s).relief, Relief(1, 1));
    EXPECT_EQ(draw(keeper, 120ms, kGeometryBound, 60s, 40s).moves, 0) << "it settles";
    EXPECT_EQ(draw(keeper, 200ms, kGeometryBound, 30s, 100s).relief, Relief(1, 2));
    EXPECT_EQ(draw(keeper, 50ms, kGeometryBound, 10s, 130s).relief, Relief());
}

TEST(RateKeeper, TheLargestErrorDoesNotFit_ResolutionGoesToo) {
    RateKeeper keeper;
    keeper.setTarget(15, true);
    EXPECT_EQ(draw(keeper, 400ms, kGeometryBound, 30s).relief, Relief(0.6, 2));
    EXPECT_EQ(draw(keeper, 50ms, kGeometryBound, 20s, 30s).relief, Relief());
}

TEST(RateKeeper, ErrorsSaveNothing_AreNotKept) {
    RateKeeper keeper;
    keeper.setTarget(15, true);
    const Relief relief = draw(keeper, 120ms, {1, 0.99, 0.98, 0.97}, 30s).relief;
    EXPECT_EQ(relief.geometry_error_px, 0);
    EXPECT_LT(relief.scale, 1);
    EXPECT_EQ(draw(keeper, 50ms, {1, 0.99, 0.98, 0.97}, 20s, 30s).relief, Relief());
    EXPECT_EQ(draw(keeper, 120ms, kGeometryBound, 20s, 50s).relief, Relief(1, 1)) << "tried again";
}

} // namespace
} // namespace froxel::session

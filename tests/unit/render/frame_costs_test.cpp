#include "render/frame/frame_costs.h"
#include "render/frame/step.h"

#include <gtest/gtest.h>

#include <vector>

namespace froxel::render {
namespace {

cluster::ClusterGrid gridOf(const settings::GridSize& size, const settings::Size& image) {
    return cluster::makeClusterGrid({.size = size}, image, settings::Camera{}, 0.1, 100);
}

// A step of one pass, with a cost that the test gives it.
class OnePass final : public Step {
  public:
    using Cost = RegionCost (*)(const FrameCosts& costs);

    OnePass(const char* label, Cost cost, PairCost UnitCosts::*loops = nullptr)
        : label_(label), cost_(cost), loops_(loops) {}

    void addCosts(const FrameCosts& costs, std::vector<PassEstimate>& passes) const override {
        passes.push_back({label_, timeOver(cost_(costs), costs.load().size.drawn)});
    }
    [[nodiscard]] double loopCost(const FrameCosts& costs) const override {
        return loops_ != nullptr ? costs.shadedLoop(costs.unit().*loops_) : 0;
    }

  private:
    const char* label_;
    Cost cost_;
    PairCost UnitCosts::*loops_;
};

RegionCost lightingCost(const FrameCosts& costs) {
    return costs.shading(costs.unit().compute);
}

OnePass lighting() {
    return {"lighting", lightingCost, &UnitCosts::compute};
}

OnePass forward(OnePass::Cost cost) {
    return {"forward", cost, &UnitCosts::fragment};
}

struct Load {
    OnePass step = lighting();
    std::vector<ActiveStep> steps = {{&step, false}};
    DrawList draws;
    [[nodiscard]] CostInputs of(const PairBound& pairs) const {
        return {.draws = draws,
                .size = {.drawn = {640, 360}, .shown = {640, 360}},
                .pairs = pairs,
                .steps = steps};
    }
};

} // namespace

TEST(PairBound, Lists_CountEachPixelWithItsTilesLongest) {
    const auto grid = gridOf({2, 1, 3}, {100, 10});
    cluster::LightLists lists;
    for (const uint32_t count : {1U, 2U, 7U, 0U, 0U, 5U}) { // x fastest, then z
        lists.clusters.push_back({0, count});
    }
    const auto bound = PairBound::lists(grid, lists);
    EXPECT_EQ(bound.longest(), 7U);
    EXPECT_EQ(bound.pairs({{0, 0}, {50, 10}}), 500 * 7);
    EXPECT_EQ(bound.pairs({{50, 0}, {50, 10}}), 500 * 5);
    EXPECT_EQ(bound.pairs({{40, 8}, {20, 2}}), 20 * 7 + 20 * 5);
}

TEST(PairBound, Uniform_IsPixelsTimesLights) {
    EXPECT_EQ(PairBound::uniform(1000).pairs({{8, 8}, {10, 3}}), 30'000);
    EXPECT_EQ(PairBound().pairs({{0, 0}, {10, 10}}), 0);
}

// 640x360 pixels of a million lights: what the lists hold decides, not their 95th percentile.
TEST(FrameCosts, OneLongList_CountsWhole) {
    const Load load;
    const auto grid = gridOf({1, 1, 256}, {640, 360});
    cluster::LightLists lists;
    lists.clusters.assign(256, {0, 1});
    lists.clusters[100].count = 1'000'000;
    const FrameCosts costs(kCpuUnitCosts, load.of(PairBound::lists(grid, lists)));
    EXPECT_GT(costs.total(), Seconds(100));
    const auto refused = costs.check(Seconds(1), Seconds(1));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kTooLong);
    EXPECT_NE(refused.error().message.find("for lighting"), std::string::npos);
}

TEST(FrameCosts, MoreToLightAPixel_CountsOnceForEach) {
    const Load load;
    CostInputs more = load.of(PairBound::uniform(10));
    const Seconds before = FrameCosts(kCpuUnitCosts, more).total();
    more.lit_pixel = 1e-6;
    const Seconds after = FrameCosts(kCpuUnitCosts, more).total();
    EXPECT_NEAR((after - before).count(), 640 * 360 * 1e-6, 1e-9);
}

// Each of the pixels that lie over each other is shaded, but behind a prepass one.
TEST(FrameCosts, Forward_IsWhatItsPixelsAndTrianglesTake) {
    Load load;
    load.draws.triangle_count = 5000;
    const UnitCosts& unit = kCpuUnitCosts;
    const double pixel = unit.surface_pixel + 10 * unit.fragment.pair + unit.lit_pixel;
    const double triangles = 5000 * unit.triangle;
    const auto estimate = [&] {
        return FrameCosts(unit, load.of(PairBound::uniform(10))).total().count();
    };
    OnePass alone = forward([](const FrameCosts& costs) { return costs.shadedSurfaces(3); });
    load.steps = {{&alone, false}};
    const double expected = 3 * 640 * 360 * pixel + triangles;
    EXPECT_NEAR(estimate(), expected, 1e-9 * expected);
    OnePass depth("depth", [](const FrameCosts& costs) { return costs.depth(); });
    OnePass after = forward([](const FrameCosts& costs) { return costs.shadedSurfaces(1); });
    load.steps = {{&depth, false}, {&after, false}};
    const double behind = 640 * 360 * (pixel + unit.depth_pixel) + triangles + triangles / 2;
    EXPECT_NEAR(estimate(), behind, 1e-9 * behind);
    load.steps[0].reused = true;
    EXPECT_LT(estimate(), behind - 640 * 360 * unit.depth_pixel / 2);
}

// Lights are added up for a coat as for what is below it, where the forward shader adds them up.
TEST(FrameCosts, Coats_LightForwardPixelsTwice) {
    Load load;
    OnePass shaded = forward([](const FrameCosts& costs) { return costs.shadedSurfaces(1); });
    load.steps = {{&shaded, false}};
    CostInputs coated = load.of(PairBound::uniform(10));
    const auto estimate = [&] { return FrameCosts(kCpuUnitCosts, coated).total().count(); };
    const double once = estimate();
    coated.lit_surfaces = 2;
    const UnitCosts& unit = kCpuUnitCosts;
    EXPECT_NEAR(estimate() - once, 640 * 360 * (10 * unit.fragment.pair + unit.lit_pixel),
                1e-6 * once);
    const uint64_t within = FrameCosts(kGpuUnitCosts, coated).lightsWithin(Seconds(1));
    coated.lit_surfaces = 1;
    EXPECT_NEAR(static_cast<double>(FrameCosts(kGpuUnitCosts, coated).lightsWithin(Seconds(1))),
                2.0 * static_cast<double>(within), 2);
}

// On a GPU: few pixels are few pairs, and each takes its lights one after another.
TEST(FrameCosts, LongLoopOfFewPixels_CountsAndMayBeRefused) {
    const Load load;
    CostInputs few = load.of(PairBound::uniform(900'000));
    few.size.drawn = few.size.shown = {16, 16};
    const FrameCosts unknown(kGpuUnitCosts, few);
    EXPECT_LT(unknown.total(), Seconds(0.01));
    EXPECT_TRUE(unknown.check(Seconds(1), Seconds(0.05)));
    few.longest_loop = 900'000;
    const FrameCosts known(kGpuUnitCosts, few);
    EXPECT_GT(known.total(), Seconds(0.1));
    EXPECT_TRUE(known.check(Seconds(1), Seconds(1)));
    EXPECT_FALSE(known.check(Seconds(1), Seconds(0.05)));
    few.longest_loop = known.lightsWithin(Seconds(0.05));
    EXPECT_TRUE(FrameCosts(kGpuUnitCosts, few).check(Seconds(1), Seconds(0.05)));
    ++few.longest_loop;
    EXPECT_FALSE(FrameCosts(kGpuUnitCosts, few).check(Seconds(1), Seconds(0.05)));
}

// On a CPU device a part of 8x8 pixels has one core.
TEST(FrameCosts, LongLoopOnACpu_IsLongerThanItsPixelsShareOfAllCores) {
    const Load load;
    CostInputs few = load.of(PairBound::uniform(100'000));
    few.size.drawn = few.size.shown = {8, 8};
    few.longest_loop = 100'000;
    const FrameCosts costs(kCpuUnitCosts, few);
    EXPECT_GT(lightingCost(costs).least, lightingCost(costs).of({{0, 0}, {8, 8}}));
    EXPECT_FALSE(costs.check(Seconds(10), lightingCost(costs).least / 2));
    EXPECT_TRUE(costs.check(Seconds(10), lightingCost(costs).least * 10));
}

// Cutting a picture does not make one pixel's loop shorter.
TEST(FrameCosts, Loop_IsOfEveryPart) {
    const Load load;
    CostInputs long_loop = load.of(PairBound::uniform(100'000));
    long_loop.longest_loop = 100'000;
    const FrameCosts costs(kGpuUnitCosts, long_loop);
    const auto lighting = lightingCost(costs);
    EXPECT_NEAR(lighting.least.count(), 100'000 * kGpuUnitCosts.compute.loop, 1e-9);
    const vk::Rect2D half{{0, 0}, {640, 180}};
    const vk::Rect2D whole{{0, 0}, {640, 360}};
    EXPECT_NEAR(lighting.of(whole).count(), 2 * lighting.of(half).count(), 1e-9);
}

TEST(FrameCosts, AllPasses_CountTogetherInTheirOrder) {
    const Load few;
    Load many;
    OnePass filter("filter", [](const FrameCosts& costs) { return costs.screen(); });
    many.steps = {{&many.step, false}, {&filter, false}, {&filter, false}};
    const FrameCosts one(kCpuUnitCosts, few.of(PairBound::uniform(500)));
    const FrameCosts more(kCpuUnitCosts, many.of(PairBound::uniform(500)));
    EXPECT_GT(more.total(), one.total());
    EXPECT_TRUE(one.check(one.total(), Seconds(1)));
    EXPECT_FALSE(more.check(one.total(), Seconds(1)));
    const auto passes = more.passes();
    ASSERT_EQ(passes.size(), 3U);
    EXPECT_STREQ(passes[0].pass, "lighting");
    EXPECT_STREQ(passes[1].pass, "filter");
    EXPECT_EQ(passes[1].time, passes[2].time);
}

TEST(FrameCosts, PairsWithinALimit_FillIt) {
    const Load load;
    const FrameCosts dark(kGpuUnitCosts, load.of(PairBound::uniform(0)));
    const double pairs = dark.pairsWithin(Seconds(0.05));
    const auto each = static_cast<uint64_t>(pairs / (640 * 360));
    const FrameCosts lit(kGpuUnitCosts, load.of(PairBound::uniform(each)));
    EXPECT_NEAR(lit.total().count(), 0.05, 0.001);
}

// The same lines over a picture four times as wide and high take longer, and are cut smaller.
TEST(FrameCosts, Lines_CountWhatTheyCover) {
    const Load load;
    const FrameCosts costs(kCpuUnitCosts, load.of({}));
    EXPECT_GT(costs.lines(65'000, 1600), 10 * costs.lines(65'000, 100));
    EXPECT_NEAR(costs.lines(1, 100).count() * 65'000, costs.lines(65'000, 100).count(), 1e-9);
}

// All passes that loop over lights share what there is.
TEST(FrameCosts, PairsWithinALimit_CountEveryPass) {
    const Load lit;
    Load both;
    OnePass counting(
        "count", [](const FrameCosts& costs) { return costs.shading(costs.unit().counting); },
        &UnitCosts::counting);
    both.steps.push_back({&counting, false});
    const double alone = FrameCosts(kGpuUnitCosts, lit.of({})).pairsWithin(Seconds(0.05));
    const double counted = FrameCosts(kGpuUnitCosts, both.of({})).pairsWithin(Seconds(0.05));
    EXPECT_LT(counted, alone / 5);
}

} // namespace froxel::render

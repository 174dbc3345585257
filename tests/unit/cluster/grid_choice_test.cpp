#include "assign_cases.h"
#include "cluster/grid_choice.h"

#include <gtest/gtest.h>

#include <random>

namespace froxel::cluster::testing {
namespace {

// Lights in a hall of 20 x 8 x 10 m, seen from its end.
light::FrameLights hallLights(uint32_t count, double radius_m) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    light::FrameLights lights;
    for (uint32_t i = 0; i < count; ++i) {
        addPoint(lights, {5 * unit(random), 2 + 4 * unit(random), -7 + 10 * unit(random)},
                 radius_m);
    }
    return lights;
}

// What a choice is made by, and what the facts refer to.
struct Situation {
    ClusterGrid frustum;
    LightSpread spread;
    DepthRange range{3, 19};
    GridCosts costs = kCpuCosts;
    settings::GridLaw law = settings::GridLaw::kLogarithmic;

    Situation(const light::FrameLights& lights,
              const settings::Size& image = {1280, 720},
              const settings::Camera& camera = perspective(45))
        : frustum(makeClusterGrid({}, image, camera, 1, 2)), spread(lightSpread(frustum, lights)) {}
    [[nodiscard]] GridFacts facts() const { return {frustum, range, law, spread, costs}; }
};

TEST(GridChoice, AnyPicture_IsCoveredWithinTheBudget) {
    for (const uint32_t width : {16U, 17U, 640U, 1919U, 4096U}) {
        for (const uint32_t height : {16U, 33U, 1079U, 4096U}) {
            for (const uint32_t count : {0U, 1U, 5000U}) {
                Situation situation(hallLights(count, 2), {width, height});
                const GridChoice choice = chooseGrid(situation.facts(), {});
                const ClusterGrid grid =
                    makeClusterGrid(choice.shape, {width, height}, perspective(45), 3, 19);
                EXPECT_EQ(grid.tile_width_px % 8, 0U);
                EXPECT_EQ(grid.tile_width_px, choice.memory.tile_px);
                EXPECT_EQ(grid.usedColumns(), choice.shape.size.x);
                EXPECT_EQ(grid.usedRows(), choice.shape.size.y);
                EXPECT_TRUE(settings::kGridXRange.contains(choice.shape.size.x));
                EXPECT_TRUE(settings::kGridYRange.contains(choice.shape.size.y));
                EXPECT_TRUE(settings::kGridZRange.contains(choice.shape.size.z));
                EXPECT_LE(grid.clusterCount() * kClusterBytes, kAutomaticGridBytes);
                EXPECT_FALSE(choice.why.empty());
            }
        }
    }
}

TEST(GridChoice, SameFacts_GiveTheSameChoice) {
    const Situation situation(hallLights(1000, 2));
    const GridChoice first = chooseGrid(situation.facts(), {});
    const GridChoice again = chooseGrid(situation.facts(), {});
    EXPECT_EQ(first.shape, again.shape);
    EXPECT_EQ(first.why, again.why);
    EXPECT_EQ(chooseGrid(situation.facts(), first.memory).shape, first.shape);
}

TEST(GridChoice, SmallerLights_GetSmallerClusters) {
    Situation small(hallLights(5000, 0.3));
    Situation large(hallLights(5000, 4));
    const auto clusters = [](const GridChoice& choice) {
        return choice.shape.size.x * choice.shape.size.y * choice.shape.size.z;
    };
    EXPECT_GT(clusters(chooseGrid(small.facts(), {})), clusters(chooseGrid(large.facts(), {})));
}

// A light that grows and shrinks a little about where two grids cost the same.
TEST(GridChoice, SmallChanges_DoNotFlipIt) {
    GridMemory memory;
    int changes = 0;
    for (int frame = 0; frame < 200; ++frame) {
        Situation situation(hallLights(1000, 1.5 + 0.05 * std::sin(frame)));
        const GridChoice choice = chooseGrid(situation.facts(), memory);
        changes += choice.memory != memory ? 1 : 0;
        memory = choice.memory;
    }
    EXPECT_EQ(changes, 1); // the first
}

TEST(GridChoice, LargeChanges_MoveIt) {
    const Situation small(hallLights(20'000, 0.1));
    const Situation large(hallLights(300, 6), {320, 180});
    const GridChoice first = chooseGrid(small.facts(), {});
    EXPECT_NE(chooseGrid(large.facts(), first.memory).memory, first.memory);
}

TEST(GridChoice, Laws_AreKept) {
    Situation situation(hallLights(1000, 2));
    for (const auto law : {settings::GridLaw::kLogarithmic, settings::GridLaw::kLinear,
                           settings::GridLaw::kHyperbolic}) {
        situation.law = law;
        EXPECT_EQ(chooseGrid(situation.facts(), {}).shape.law, law);
    }
}

// Against lists that were made: the model need not be better to rank grids.
TEST(GridChoice, Expectation_IsNearTheLists) {
    for (const double radius : {0.3, 1.0, 2.0, 5.0}) {
        for (const GridShape& shape :
             {GridShape{{16, 9, 24}, {}, 80, 80}, GridShape{{40, 23, 16}, {}, 32, 32},
              GridShape{{5, 3, 4}, {}, 256, 256}}) {
            const auto lights = hallLights(3000, radius);
            const Situation situation(lights);
            const ClusterGrid grid = makeClusterGrid(shape, {1280, 720}, perspective(45),
                                                     situation.range.near_m, situation.range.far_m);
            const LightLists lists = assigned(grid, lights);
            // Points among the lights, at any depth alike.
            std::mt19937 random(9);
            std::uniform_real_distribution<double> unit(0, 1);
            double sum = 0;
            int points = 0;
            for (int i = 0; i < 20'000; ++i) {
                const double depth = 17 * unit(random);
                const double x = (2 * unit(random) - 1) * grid.half_x * depth;
                const double y = (2 * unit(random) - 1) * grid.half_y * depth;
                const auto slice = grid.sliceAt(static_cast<float>(depth));
                if (std::abs(x) > 5 || std::abs(y - 2) > 4 || !slice) {
                    continue;
                }
                const auto column = static_cast<uint32_t>((x / depth / grid.half_x + 1) * 640);
                const auto row = static_cast<uint32_t>((1 - y / depth / grid.half_y) * 360);
                sum += lists
                           .clusters[grid.clusterIndex(column / grid.tile_width_px,
                                                       row / grid.tile_height_px, *slice)]
                           .count;
                ++points;
            }
            const double mean = sum / points;
            const double expected = expectedListLength(situation.facts(), shape);
            EXPECT_GT(expected, mean / 1.5) << radius << ", " << shape.size.x;
            EXPECT_LT(expected, mean * 2.2) << radius << ", " << shape.size.x;
        }
    }
}

TEST(LoopChoice, FewLights_AreLoopedOver) {
    GridMemory lists;
    GridMemory all;
    all.all_lights = true;
    const Situation few(hallLights(16, 0.5));
    const Situation more(hallLights(18, 0.5));
    const Situation many(hallLights(100, 0.5));
    EXPECT_TRUE(chooseLoop(few.facts(), 1, lists).all_lights);
    EXPECT_FALSE(chooseLoop(more.facts(), 1, lists).all_lights);
    EXPECT_TRUE(chooseLoop(more.facts(), 1, all).all_lights); // kept
    EXPECT_FALSE(chooseLoop(many.facts(), 1, all).all_lights);
}

TEST(LoopChoice, HugeRadii_AreLoopedOver) {
    const Situation situation(hallLights(500, 50));
    const GridChoice choice = chooseGrid(situation.facts(), {});
    EXPECT_GT(choice.list_length, 400);
    const LoopChoice loop = chooseLoop(situation.facts(), choice.list_length, choice.memory);
    EXPECT_TRUE(loop.all_lights);
    EXPECT_NE(loop.why.find("500 lights"), std::string::npos);
}

TEST(LoopChoice, AboutHalf_KeepsWhatItWas) {
    const Situation situation(hallLights(100, 1));
    GridMemory lists;
    GridMemory all;
    all.all_lights = true;
    EXPECT_FALSE(chooseLoop(situation.facts(), 50, lists).all_lights);
    EXPECT_TRUE(chooseLoop(situation.facts(), 50, all).all_lights);
    EXPECT_TRUE(chooseLoop(situation.facts(), 56, lists).all_lights);
    EXPECT_FALSE(chooseLoop(situation.facts(), 44, all).all_lights);
}

TEST(LightSpread, Block_HasItsOwnVolume) {
    const ClusterGrid frustum = makeClusterGrid({}, {1280, 720}, perspective(45), 1, 2);
    const LightSpread spread = lightSpread(frustum, hallLights(20'000, 0.01));
    EXPECT_NEAR(spread.volume_m3, 10 * 8 * 20, 100);
    EXPECT_NEAR(spread.radius1_m, 0.01, 1e-6);
    EXPECT_EQ(spread.light_count, 20'000U);
}

TEST(LightSpread, UnlimitedAndHiddenLights_AreToldApart) {
    const ClusterGrid frustum = makeClusterGrid({}, {1280, 720}, perspective(45), 1, 2);
    light::FrameLights lights;
    addPoint(lights, {0, 0, -5}, 1);
    addPoint(lights, {0, 0, 5}, 1);
    addPoint(lights, {0, 0, -5}, kUnlimited);
    addPoint(lights, {50, 0, -5}, 1);
    const LightSpread spread = lightSpread(frustum, lights);
    EXPECT_DOUBLE_EQ(spread.unlimited_share, 0.25);
    ASSERT_EQ(spread.seen_depths_m.size(), 1U);
    EXPECT_DOUBLE_EQ(spread.seen_depths_m[0], 5);
    EXPECT_DOUBLE_EQ(spread.lights_per_depth, 1);
}

} // namespace
} // namespace froxel::cluster::testing

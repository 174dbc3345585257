#include "interface/heat_map.h"
#include "render/frame/debug_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

namespace froxel::render {

namespace {

using settings::DebugView;

DebugLegend legendOf(DebugView view, const DebugFacts& facts, double scale_max = 0) {
    return makeLegend({.view = view, .scale_max = scale_max, .grid_camera = {}}, facts);
}

} // namespace

TEST(HeatMap, EveryPosition_HasAColorOfItsOwn) {
    std::set<uint32_t> colors;
    for (uint32_t i = 0; i <= io::kHeatTop; ++i) {
        colors.insert(io::heatColor(i));
    }
    EXPECT_EQ(colors.size(), io::kHeatTop + 1);
    EXPECT_EQ(io::heatColor(0), 0xff540144U);
    EXPECT_EQ(io::heatColor(io::kHeatTop), 0xff25e7fdU);
}

TEST(HeatMap, Counts_AtTheTopAndBeyond_AreTheTop) {
    EXPECT_EQ(io::heatPosition(0, 7), 0U);
    EXPECT_EQ(io::heatPosition(6, 7), 6U * 256 / 7);
    EXPECT_EQ(io::heatPosition(7, 7), io::kHeatTop);
    EXPECT_EQ(io::heatPosition(1'000'000, 7), io::kHeatTop);
    EXPECT_EQ(io::heatPosition(999'999, 1'000'000), 255U);
}

TEST(DebugLegend, Scales_AreChosenOrGiven) {
    const DebugFacts lists{
        .light_count = 900, .lists = true, .list_length = 20, .slice_count = 24, .farthest_m = 37};
    EXPECT_EQ(legendOf(DebugView::kListedLights, lists).max, 128); // four times 20, rounded up
    EXPECT_EQ(legendOf(DebugView::kListedLights, lists, 50).max, 50);
    EXPECT_EQ(legendOf(DebugView::kListedLights, lists, 50.5).max, 51);
    EXPECT_EQ(legendOf(DebugView::kClusterSlices, lists).max, 23);
    EXPECT_EQ(legendOf(DebugView::kDepth, lists).max, 64);
    EXPECT_EQ(legendOf(DebugView::kDepth, lists, 2.5).max, 2.5);
    EXPECT_EQ(legendOf(DebugView::kFalsePositives, lists, 9).max, 1); // a share
    DebugFacts all = lists;
    all.lists = false;
    EXPECT_EQ(legendOf(DebugView::kEvaluatedLights, all).max, 900);
    EXPECT_TRUE(legendOf(DebugView::kNormal, lists).colors.empty());
    EXPECT_EQ(legendOf(DebugView::kDepth, lists).colors.size(), io::kHeatStops);
}

TEST(ClusterWires, FrozenCamera_IsWhereItWas) {
    settings::ViewSettings settings;
    const auto grid =
        cluster::makeClusterGrid({.size = {4, 3, 5}}, {80, 60}, settings.camera, 0.5, 20);
    const auto own = clusterWires(grid, settings.camera, settings.camera);
    // Rays between tiles, then for each slice a line a column's and a row's edge.
    ASSERT_EQ(own.size(), 2U * (5 * 4 + 5 * (5 + 4)));
    EXPECT_EQ(own[0].position_view, glm::vec3(0));
    const double half = std::tan(settings.camera.yfov_rad / 2);
    const double far_m = static_cast<double>(grid.plane_depths_m.back());
    EXPECT_NEAR(own[1].position_view.x, -half * 80 / 60 * far_m, 1e-4); // left, up
    EXPECT_NEAR(own[1].position_view.y, half * far_m, 1e-4);
    EXPECT_NEAR(own[1].position_view.z, -far_m, 1e-4);

    const auto other = settings::lookAt({3, 4, 5}, {1, 0, -7}, {0, 1, 0});
    const auto seen = clusterWires(grid, settings.camera, other);
    ASSERT_EQ(seen.size(), own.size());
    for (size_t i = 0; i < own.size(); ++i) {
        const glm::dvec3 world(own[i].position_view); // the frozen camera's axes are the world's
        const glm::vec3 expected(glm::transpose(other.world_from_view) * (world - other.eye_world));
        EXPECT_LT(glm::distance(seen[i].position_view, expected), 1e-4F);
        EXPECT_EQ(seen[i].color, own[i].color);
    }
}

TEST(WirePixels, OfALineAcross_AreThePicturesWidth) {
    const settings::Size size{400, 200};
    settings::Camera camera;
    const auto depth = static_cast<float>(100 / std::tan(camera.yfov_rad / 2)); // 1 m, 1 pixel
    const auto at = [&](float x, float y) {
        return io::WireVertex{.position_view = {x, y, -depth}, .color = {}};
    };
    const std::vector<io::WireVertex> lines{at(-50, 0), at(50, 0), at(0, -1e6F), at(0, 1e6F)};
    EXPECT_NEAR(wirePixels(lines, camera, size), 100 + 200, 0.01);
    camera.projection = settings::Projection::kOrthographic;
    camera.half_height_m = 50;
    EXPECT_NEAR(wirePixels(lines, camera, size), 200 + 200, 0.01);
    EXPECT_EQ(wirePixels({}, camera, size), 0);
}

TEST(WirePixels, OfLights_AreNoMoreThanThePictureShows) {
    const settings::Size size{400, 200};
    const settings::Camera camera;
    const double depth = 100 / std::tan(camera.yfov_rad / 2);
    light::FrameLights lights;
    const auto add = [&](float radius_m) {
        lights.lights.push_back({});
        lights.lights.back().position_view = {0, 0, static_cast<float>(-depth)};
        lights.radii_m.push_back(radius_m);
    };
    add(10);
    EXPECT_NEAR(lightWirePixels(lights, camera, size), 3 * 20 * std::numbers::pi, 0.01);
    add(std::numeric_limits<float>::infinity()); // has no end to show
    EXPECT_NEAR(lightWirePixels(lights, camera, size), 3 * 20 * std::numbers::pi, 0.01);
    add(1e9F);
    EXPECT_NEAR(lightWirePixels(lights, camera, size), 3 * (20 * std::numbers::pi + 1200), 0.01);
}

} // namespace froxel::render

// Capped lists keep what matters most, and tell what they dropped.
#include "cluster/list_cap.h"
#include "light/light_rig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

namespace froxel::cluster {
namespace {

constexpr settings::Size kImage{320, 180};

struct Capped {
    ClusterGrid grid;
    light::FrameLights lights;
    LightLists all;
    LightLists capped;
};

Capped cappedLists(uint32_t cap,
                   settings::Projection projection = settings::Projection::kPerspective) {
    settings::Lights settings;
    settings.count = 400;
    settings.radius_m = 3;
    settings.box = BoundsD3{{-8, -4, -12}, {8, 4, -1}};
    settings::Camera camera;
    camera.projection = projection;
    camera.half_height_m = 4;
    Capped result;
    light::LightRig(scene::Scene{}).evaluate(settings, camera, 2.5, result.lights);
    result.grid = makeClusterGrid({.size = {9, 5, 12}}, kImage, camera, 0.5, 20);
    LightAssigner assigner(2);
    assigner.assign(result.grid, result.lights, result.all);
    result.capped = result.all;
    ListCap whole(result.grid, result.lights, cap, assigner.crew(), result.capped);
    EXPECT_TRUE(whole.advance());
    return result;
}

std::span<const uint32_t> listOf(const LightLists& lists, uint32_t cluster) {
    const io::ClusterList& list = lists.clusters[cluster];
    return std::span(lists.indices).subspan(list.offset, list.count);
}

TEST(ListCap, NotReached_ChangesNothing) {
    const Capped result = cappedLists(400);
    EXPECT_EQ(result.capped.indices, result.all.indices);
    EXPECT_EQ(result.capped.stats.capped_count, 0U);
    EXPECT_EQ(result.capped.stats.dropped_irradiance, 0);
    EXPECT_EQ(result.capped.stats.p95, result.all.stats.p95);
    EXPECT_EQ(result.capped.stats.mean, result.all.stats.mean);
}

TEST(ListCap, Reached_KeepsAscendingLightsOfTheList) {
    constexpr uint32_t kCap = 12U;
    const Capped result = cappedLists(kCap);
    ASSERT_GT(result.all.stats.largest, 2 * kCap); // or the test says little
    uint32_t at = 0;
    uint32_t capped_count = 0;
    uint64_t dropped_count = 0;
    for (uint32_t cluster = 0; cluster < result.grid.clusterCount(); ++cluster) {
        const auto whole = listOf(result.all, cluster);
        const auto kept = listOf(result.capped, cluster);
        EXPECT_EQ(result.capped.clusters[cluster].offset, at);
        at += static_cast<uint32_t>(kept.size());
        ASSERT_EQ(kept.size(), std::min(whole.size(), size_t{kCap}));
        EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
        EXPECT_TRUE(std::includes(whole.begin(), whole.end(), kept.begin(), kept.end()));
        capped_count += whole.size() > kCap ? 1U : 0U;
        dropped_count += whole.size() - kept.size();
    }
    EXPECT_EQ(result.capped.indices.size(), at);
    EXPECT_EQ(result.capped.stats.entry_count, at);
    EXPECT_EQ(result.capped.stats.largest, kCap);
    EXPECT_EQ(result.capped.stats.capped_count, capped_count);
    EXPECT_EQ(result.capped.stats.dropped_count, dropped_count);
}

// What a pixel lacks at points all over the clusters, in double: never more than was told.
TEST(ListCap, Dropped_IsAtLeastWhatAnyPointLacks) {
    for (const auto projection :
         {settings::Projection::kPerspective, settings::Projection::kOrthographic}) {
        const Capped result = cappedLists(8, projection);
        std::mt19937 random(3);
        std::uniform_real_distribution<double> share(0, 1);
        double worst = 0;
        for (uint32_t cluster = 0; cluster < result.grid.clusterCount(); ++cluster) {
            const uint32_t x = cluster % result.grid.size.x;
            const uint32_t y = cluster / result.grid.size.x % result.grid.size.y;
            const uint32_t z = cluster / (result.grid.size.x * result.grid.size.y);
            const Cell cell = result.grid.cell(x, y, z);
            const auto kept = listOf(result.capped, cluster);
            for (int i = 0; i < 20; ++i) {
                const double depth = cell.z0 + share(random) * (cell.z1 - cell.z0);
                const double scale = projection == settings::Projection::kPerspective ? depth : 1;
                const glm::dvec3 point(scale * (cell.x0 + share(random) * (cell.x1 - cell.x0)),
                                       -scale * (cell.y0 + share(random) * (cell.y1 - cell.y0)),
                                       -depth);
                double lacking = 0;
                for (const uint32_t light : listOf(result.all, cluster)) {
                    if (!std::binary_search(kept.begin(), kept.end(), light)) {
                        lacking += mostIrradiance(result.lights, result.lights.lights[light], point,
                                                  point);
                    }
                }
                worst = std::max(worst, lacking);
            }
        }
        EXPECT_LE(worst, result.capped.stats.dropped_irradiance);
        EXPECT_GT(worst, 0); // or the test says nothing
    }
}

// A light that fills its cluster with light stays, whatever its place in the list.
// Of the cluster that loses most, not of all together. Orthographic cells are boxes.
TEST(ListCap, Dropped_IsTheSumOfTheWorstCluster) {
    const Capped result = cappedLists(8, settings::Projection::kOrthographic);
    double worst = 0;
    double together = 0;
    for (uint32_t cluster = 0; cluster < result.grid.clusterCount(); ++cluster) {
        const uint32_t line = cluster / result.grid.size.x;
        const Cell cell = result.grid.cell(cluster % result.grid.size.x, line % result.grid.size.y,
                                           line / result.grid.size.y);
        const auto kept = listOf(result.capped, cluster);
        double lost = 0;
        for (const uint32_t light : listOf(result.all, cluster)) {
            if (!std::binary_search(kept.begin(), kept.end(), light)) {
                lost +=
                    mostIrradiance(result.lights, result.lights.lights[light],
                                   {cell.x0, -cell.y1, -cell.z1}, {cell.x1, -cell.y0, -cell.z0});
            }
        }
        worst = std::max(worst, lost);
        together += lost;
    }
    ASSERT_GT(together, 10 * worst);
    EXPECT_NEAR(result.capped.stats.dropped_irradiance, worst, 1e-9 * worst);
}

TEST(ListCap, Strongest_Stays) {
    settings::Lights settings;
    settings.count = 0;
    light::FrameLights lights;
    for (int i = 0; i < 5; ++i) {
        io::Light light{};
        light.position_view = {0.1F * static_cast<float>(i), 0, 1}; // 1 m before the nearest point
        light.inv_radius2 = 0.01F;
        light.color = glm::vec3(i == 3 ? 100.0F : 1.0F);
        light.spot = io::kNoSpot;
        lights.lights.push_back(light);
        lights.radii_m.push_back(10);
    }
    const ClusterGrid grid = makeClusterGrid({.size = {1, 1, 1}}, kImage, {}, 1, 20);
    LightLists lists;
    LightAssigner assigner(1);
    assigner.assign(grid, lights, lists);
    ASSERT_EQ(lists.clusters[0].count, 5U);
    EXPECT_TRUE(ListCap(grid, lights, 1, assigner.crew(), lists).advance());
    ASSERT_EQ(lists.clusters[0].count, 1U);
    EXPECT_EQ(lists.indices, std::vector<uint32_t>{3});
    const double window = 1 - 0.01 * 0.01;
    EXPECT_NEAR(lists.stats.dropped_irradiance, 4 * window * window, 1e-6);
}

TEST(ListCap, InParts_SameLists) {
    const Capped whole = cappedLists(12);
    LightLists lists = whole.all;
    Crew crew(2);
    ListCap parts(whole.grid, whole.lights, 12, crew, lists);
    int count = 1;
    for (; !parts.advance(1000); ++count) {
    }
    EXPECT_GT(count, 3);
    EXPECT_EQ(lists.indices, whole.capped.indices);
    EXPECT_EQ(lists.stats.p95, whole.capped.stats.p95);
    EXPECT_EQ(lists.stats.dropped_count, whole.capped.stats.dropped_count);
    EXPECT_EQ(lists.stats.dropped_irradiance, whole.capped.stats.dropped_irradiance);
}

TEST(MostIrradiance, IsTheShadersFalloffAtTheNearestPoint) {
    io::Light light{};
    light.position_view = {0, 0, -1};
    light.inv_radius2 = 0.25F;
    light.color = {0.5F, 3, 1};
    light.spot = io::kNoSpot;
    const auto at = [&](double nearest, double farthest) {
        return mostIrradiance({}, light, {-1, -1, -farthest}, {1, 1, -nearest});
    };
    const double window = 1 - 0.25 * 0.25;
    EXPECT_DOUBLE_EQ(at(2, 9), 3 * window * window); // 1 m away of a radius of 2
    EXPECT_EQ(at(3, 9), 0);
    EXPECT_DOUBLE_EQ(at(0.5, 2), 3 / 1e-4); // within: as at 1 cm
    light::FrameLights small;
    small.nearest_m = 1e-3;
    EXPECT_DOUBLE_EQ(mostIrradiance(small, light, {-1, -1, -2}, {1, 1, -0.5}), 3 / 1e-6);
    light.inv_radius2 = 0;
    EXPECT_DOUBLE_EQ(at(3, 9), 0.75);
}

// A corner is nearer than the centre by half a diagonal.
TEST(MostIrradiance, OfARectangle_IsAtItsNearestCorner) {
    light::FrameLights lights;
    lights.spots.push_back({.direction_view = {0, 0, -1},
                            .scale = 1,
                            .offset = 0,
                            .area = 0,
                            .padding0 = 0,
                            .padding1 = 0});
    lights.areas.push_back({.half_right_view = {0.3F, 0, 0},
                            .inv_area = 1,
                            .half_up_view = {0, 0.4F, 0},
                            .padding0 = 0});
    const io::Light light{
        .position_view = {0, 0, -1}, .inv_radius2 = 0, .color = glm::vec3(2), .spot = 0};
    EXPECT_NEAR(mostIrradiance(lights, light, {-1, -1, -9}, {1, 1, -3}), 2 / (1.5 * 1.5), 1e-6);
}

} // namespace
} // namespace froxel::cluster

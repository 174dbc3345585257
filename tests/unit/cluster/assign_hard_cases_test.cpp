// The cases that are known to break light assignment elsewhere, each against the oracle.
#include "assign_cases.h"

#include <cmath>

namespace froxel::cluster::testing {
namespace {

ClusterGrid usualGrid() {
    return makeClusterGrid({16, 9, 24}, {1280, 720}, perspective(45), 0.1, 50);
}

TEST(AssignHardCases, EyeInsideLight_IsExact) {
    light::FrameLights lights;
    for (const double offset : {0.0, 1e-3, -1e-3, 0.05, -0.05}) {
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 position(0);
            position[axis] = offset;
            addPoint(lights, position, 5);
            addPoint(lights, position, 0.01);
        }
    }
    expectExact(usualGrid(), lights);
}

TEST(AssignHardCases, CentreBehindRimAhead_IsExact) {
    light::FrameLights lights;
    for (double x = -2; x <= 2; x += 0.125) {
        addPoint(lights, {x, x / 2, 1}, 1.5);
        addPoint(lights, {0, x, 0}, 1.5);
    }
    expectExact(usualGrid(), lights);
}

TEST(AssignHardCases, WhollyBehind_IsInNoList) {
    light::FrameLights lights;
    addPoint(lights, {0, 0, 2}, 1.9);
    addPoint(lights, {5, 0, 2}, 1.9);
    addPoint(lights, {0, 0, 1e6}, 100);
    const LightLists lists = assigned(usualGrid(), lights);
    EXPECT_EQ(lists.indices.size(), 0U);
    EXPECT_EQ(lists.stats.empty_count, lists.stats.cluster_count);
}

TEST(AssignHardCases, EyeOnTheSurface_IsExact) {
    light::FrameLights lights;
    const glm::dvec3 ways[] = {{1, 0, 0}, {0, 1, 0},   {0, 0, 1},   {0, 0, -1},
                               {1, 1, 1}, {-1, 1, -1}, {0.1, 0, -1}};
    for (const glm::dvec3& way : ways) {
        for (const double scale : {1.0, 1 - 1e-7, 1 + 1e-7, 1 - 1e-4, 1 + 1e-4}) {
            addPoint(lights, glm::normalize(way) * 2.0 * scale, 2);
        }
    }
    expectExact(usualGrid(), lights);
}

// Spheres that touch each of a cell's six planes from either side, to the last bit.
TEST(AssignHardCases, TangentToClusterPlanes_IsExact) {
    const ClusterGrid grid = usualGrid();
    light::FrameLights lights;
    for (const uint32_t x : {0U, 3U, 8U, 15U}) {
        for (const uint32_t z : {0U, 5U, 23U}) {
            const Cell cell = grid.cell(x, x % 9, z);
            const double depth = cell.z0 + 0.3 * (cell.z1 - cell.z0);
            const glm::dvec3 inside((cell.x0 + cell.x1) / 2 * depth,
                                    -(cell.y0 + cell.y1) / 2 * depth, -depth);
            const double planes[][4] = {{1, 0, cell.x0, 0},   {1, 0, cell.x1, 0},
                                        {0, -1, cell.y0, 0},  {0, -1, cell.y1, 0},
                                        {0, 0, -1, -cell.z0}, {0, 0, -1, -cell.z1}};
            for (const auto& p : planes) {
                const glm::dvec3 normal(p[0], p[1], p[2]);
                const double away = (glm::dot(normal, inside) - p[3]) / glm::length(normal);
                float radius = static_cast<float>(std::abs(away));
                for (const int ulps : {-8, -1, 0, 1, 8}) {
                    float moved = radius;
                    for (int i = 0; i < std::abs(ulps); ++i) {
                        moved = std::nextafter(moved, ulps < 0 ? 0.0F : 1e9F);
                    }
                    addPoint(lights, inside, static_cast<double>(moved));
                }
            }
        }
    }
    expectExact(grid, lights);
}

TEST(AssignHardCases, WideFieldOfView_OffAxisLightIsExact) {
    const ClusterGrid grid = makeClusterGrid({16, 9, 24}, {1280, 720}, perspective(120), 0.1, 50);
    light::FrameLights lights;
    for (const double distance : {0.5, 2.0, 10.0, 30.0}) {
        for (double degrees = -85; degrees <= 85; degrees += 5) {
            const double angle = glm::radians(degrees);
            addPoint(lights,
                     {distance * std::sin(angle), 0.1 * distance, -distance * std::cos(angle)},
                     0.4 * distance);
        }
    }
    expectExact(grid, lights);
}

TEST(AssignHardCases, TinyLights_AreEachInAList) {
    const ClusterGrid grid = makeClusterGrid({16, 9, 24}, {1280, 720}, perspective(45), 0.1, 60);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-0.99, 0.99);
    light::FrameLights lights;
    for (int i = 0; i < 10'000; ++i) {
        addPoint(lights, {unit(random) * grid.half_x * 50, unit(random) * grid.half_y * 50, -50},
                 1e-3);
    }
    const LightLists lists = assigned(grid, lights);
    const auto clusters = clustersByLight(lists, lights.lights.size());
    for (const auto& of_light : clusters) {
        ASSERT_GE(of_light.size(), 1U);
        ASSERT_LE(of_light.size(), 8U);
    }
}

TEST(AssignHardCases, HugeAndUnlimitedLights_AreInEveryUsedList) {
    const ClusterGrid grid = makeClusterGrid({16, 9, 24}, {1919, 1079}, perspective(45), 0.1, 60);
    light::FrameLights lights;
    addPoint(lights, {100, -70, 40}, 1e4);
    addPoint(lights, {0, 0, 1e6}, kUnlimited);
    addPoint(lights, {1e15, 0, 0}, kUnlimited);
    const auto clusters = clustersByLight(assigned(grid, lights), 3);
    const size_t used = size_t{grid.usedColumns()} * grid.usedRows() * grid.size.z;
    for (const auto& of_light : clusters) {
        EXPECT_EQ(of_light.size(), used);
    }
}

TEST(AssignHardCases, ZeroRadius_GivesNoFault) {
    light::FrameLights lights;
    addPoint(lights, {0, 0, 0}, 0);
    addPoint(lights, {0, 0, -1}, 0);
    addPoint(lights, {1, 0, -1}, 1e-15);
    const LightLists lists = assigned(usualGrid(), lights);
    EXPECT_LE(lists.stats.largest, 3U);
}

TEST(AssignHardCases, MovedToLargeDistances_IsExact) {
    light::FrameLights lights;
    for (const double distance : {1e3, 1e5, 1e8, 1e12}) {
        addPoint(lights, {0, 0, -distance}, distance * 0.9999);
        addPoint(lights, {distance, 0, 0}, distance * 1.01);
        addPoint(lights, {0, distance, distance}, distance * 1.42);
    }
    expectExact(usualGrid(), lights);
}

TEST(AssignHardCases, Orthographic_LightsBehindAndAheadAreExact) {
    const ClusterGrid grid = makeClusterGrid({16, 9, 12}, {1280, 720}, orthographic(5), 0.5, 40);
    light::FrameLights lights;
    addPoint(lights, {0, 0, 0}, 1);
    addPoint(lights, {3, -2, 0.5}, 1);
    addPoint(lights, {8.8, 0, -10}, 2);
    addPoint(lights, {0, 0, -45}, 5.5);
    addPoint(lights, {0, 0, 2}, 1.9);
    addPoint(lights, {-30, 0, -10}, 22);
    expectExact(grid, lights);
}

} // namespace
} // namespace froxel::cluster::testing

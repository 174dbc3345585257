// Spots against the oracle: no cell with a lit point is left out, and few without are let in.
#include "assign_cases.h"
#include "cluster/spot_cut.h"

#include <cmath>
#include <ostream>

namespace froxel::cluster::testing {
namespace {

constexpr double kHalfAngles_deg[] = {0.01, 0.5,  1,  5,    20,   44.9, 45,  45.1,
                                      60,   79.9, 80, 80.1, 89.9, 90,   120, 180};

struct Count {
    size_t lit = 0;    // (spot, cluster) pairs where the oracle found a lit point
    size_t listed = 0; // pairs in the lists
};

glm::dvec3 cellAxes(const glm::dvec3& view) {
    return {view.x, -view.y, -view.z};
}

Count expectNoneMissing(const ClusterGrid& grid, const light::FrameLights& lights) {
    const LightLists lists = assigned(grid, lights);
    const auto clusters = clustersByLight(lists, lights.lights.size());
    Count count;
    for (size_t i = 0; i < lights.lights.size(); ++i) {
        const io::Light& light = lights.lights[i];
        const glm::dvec3 apex = cellAxes(glm::dvec3(light.position_view));
        const glm::dvec3 axis = cellAxes(glm::dvec3(lights.spots[light.spot].direction_view));
        const auto range = static_cast<double>(lights.radii_m[i]);
        count.listed += clusters[i].size();
        for (uint32_t z = 0; z < grid.size.z; ++z) {
            for (uint32_t y = 0; y < grid.usedRows(); ++y) {
                for (uint32_t x = 0; x < grid.usedColumns(); ++x) {
                    const Cell cell = grid.cell(x, y, z);
                    if (reference::distance(apex, cell, grid.projection) > range) {
                        continue;
                    }
                    const double cosine =
                        reference::largestCosine(apex, axis, range, cell, grid.projection);
                    if (cosine < lights.cones[light.spot].cos_outer) {
                        continue;
                    }
                    ++count.lit;
                    const uint32_t cluster = grid.clusterIndex(x, y, z);
                    EXPECT_TRUE(std::binary_search(clusters[i].begin(), clusters[i].end(), cluster))
                        << "spot " << i << ", cluster " << x << " " << y << " " << z;
                }
            }
        }
    }
    return count;
}

struct View {
    const char* name;
    settings::Camera camera;
};

void PrintTo(const View& view, std::ostream* out) {
    *out << view.name;
}

class AssignSpot : public ::testing::TestWithParam<View> {
  protected:
    [[nodiscard]] ClusterGrid grid() const {
        return makeClusterGrid({8, 5, 6}, {1280, 720}, GetParam().camera, 1, 20);
    }
};

TEST_P(AssignSpot, EveryHalfAngle_MissesNoLitCell) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (const double half_angle_deg : kHalfAngles_deg) {
        light::FrameLights lights;
        for (int i = 0; i < 8; ++i) {
            addSpot(lights, {8 * unit(random), 5 * unit(random), -9 + 11 * unit(random)},
                    i == 0 ? static_cast<double>(kUnlimited) : 5 + 4 * unit(random),
                    {unit(random), unit(random), unit(random)}, half_angle_deg);
        }
        expectNoneMissing(grid(), lights);
    }
}

TEST_P(AssignSpot, AxesAndNearAxes_MissNoLitCell) {
    light::FrameLights lights;
    const glm::dvec3 places[] = {{0, 0, -5}, {0, 0, 0}, {0.3, -0.2, 2}, {4, 1, -8}};
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {1.0, -1.0}) {
            for (const double tilt : {0.0, 1e-8, -1e-8}) {
                glm::dvec3 direction(tilt);
                direction[axis] = sign;
                for (const glm::dvec3& place : places) {
                    addSpot(lights, place, 7, direction, 25);
                }
            }
        }
    }
    expectNoneMissing(grid(), lights);
}

TEST_P(AssignSpot, FewCellsWithoutALitPoint_AreListed) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    Count total;
    for (const double half_angle_deg : {5.0, 20.0, 35.0, 50.0, 70.0}) {
        light::FrameLights lights;
        for (int i = 0; i < 20; ++i) {
            addSpot(lights, {4 * unit(random), 3 * unit(random), -9 + 6 * unit(random)},
                    7 + 3 * unit(random), {unit(random), unit(random), unit(random)},
                    half_angle_deg);
        }
        const Count count = expectNoneMissing(grid(), lights);
        total.lit += count.lit;
        total.listed += count.listed;
    }
    const double extra = static_cast<double>(total.listed) / static_cast<double>(total.lit) - 1;
    RecordProperty("extra_percent", std::to_string(extra * 100));
    EXPECT_LT(extra, 0.12);
}

TEST(SpotCut, Bound_HoldsTheConeAndIsNoLargerThanTheLights) {
    const glm::dvec3 apex(1, 2, 5);
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
    const glm::dvec3 side = glm::normalize(glm::cross(axis, glm::dvec3(0, 1, 0)));
    for (const double half_angle_deg : {1.0, 20.0, 44.0, 46.0, 60.0, 79.0}) {
        const double half = glm::radians(half_angle_deg);
        const auto cut = SpotCut::make(apex, cellAxes(axis), {std::cos(half), std::sin(half)}, 3);
        ASSERT_TRUE(cut);
        const Ball ball = cut->bound();
        const glm::dvec3 centre(ball.x, ball.y, ball.z);
        EXPECT_LE(ball.radius, 3);
        for (const double turn : {0.0, 0.5, 1.0}) {
            const glm::dvec3 ray = axis * std::cos(turn * half) + side * std::sin(turn * half);
            EXPECT_LE(glm::distance(apex + 3.0 * ray, centre), ball.radius + 1e-6)
                << half_angle_deg;
        }
        EXPECT_LE(glm::distance(apex, centre), ball.radius + 1e-6) << half_angle_deg;
    }
}

TEST_P(AssignSpot, PointingAway_IsInNoList) {
    light::FrameLights lights;
    addSpot(lights, {0, 0, 0.5}, 50, {0, 0, 1}, 60);
    addSpot(lights, {0, 0, 0.5}, kUnlimited, {0, 0, 1}, 60);
    EXPECT_EQ(assigned(grid(), lights).indices.size(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Cameras,
                         AssignSpot,
                         ::testing::Values(View{"usual", perspective(60)},
                                           View{"wide", perspective(120)},
                                           View{"orthographic", orthographic(5)}));

} // namespace
} // namespace froxel::cluster::testing

#include "assign_cases.h"
#include "cluster/cluster_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace froxel::cluster::testing {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

void expectAscending(const ClusterGrid& grid) {
    ASSERT_EQ(grid.plane_depths_m.size(), grid.size.z + 1U);
    EXPECT_EQ(grid.plane_depths_m.front(), 0.0F);
    for (size_t k = 1; k < grid.plane_depths_m.size(); ++k) {
        ASSERT_LT(grid.plane_depths_m[k - 1], grid.plane_depths_m[k]) << "plane " << k;
        ASSERT_TRUE(std::isfinite(grid.plane_depths_m[k]));
    }
}

TEST(ClusterGrid, PlaneDepths_AscendForExtremeRanges) {
    const double ranges[][2] = {{1e-3, 10}, {0.1, 1e5},   {10, 10},     {10, 10.000001},
                                {1, 0.5},   {1e-9, 1e18}, {1e-30, 1e30}};
    for (const auto& range : ranges) {
        for (const uint32_t slices : {1U, 2U, 24U, 256U}) {
            const ClusterGrid grid =
                makeClusterGrid({16, 9, slices}, {640, 360}, perspective(45), range[0], range[1]);
            expectAscending(grid);
        }
    }
}

TEST(ClusterGrid, LastPlane_IsNotBelowTheFarAskedFor) {
    for (double far_m = 1; far_m < 1e6; far_m *= 1.37) {
        const ClusterGrid grid = makeClusterGrid({1, 1, 24}, {64, 64}, perspective(45), 0.1, far_m);
        EXPECT_GE(static_cast<double>(grid.plane_depths_m.back()), far_m);
        EXPECT_LE(static_cast<double>(grid.plane_depths_m.back()), far_m * (1 + 1e-6));
    }
}

TEST(ClusterGrid, Slices_AreLogarithmic) {
    const ClusterGrid grid = makeClusterGrid({1, 1, 3}, {64, 64}, perspective(45), 1, 1000);
    EXPECT_NEAR(grid.plane_depths_m[1], 10, 0.6);
    EXPECT_NEAR(grid.plane_depths_m[2], 100, 6);
    EXPECT_NEAR(grid.plane_depths_m[3], 1000, 1e-2);
}

TEST(ClusterGrid, SliceAt_SwitchesExactlyAtThePlanes) {
    for (const uint32_t slices : {1U, 7U, 24U, 256U}) {
        const ClusterGrid grid =
            makeClusterGrid({1, 1, slices}, {64, 64}, perspective(45), 0.1, 90);
        for (uint32_t k = 1; k <= slices; ++k) {
            const float plane = grid.plane_depths_m[k];
            EXPECT_EQ(grid.sliceAt(std::nextafter(plane, 0.0F)), k - 1);
            const auto at = grid.sliceAt(plane);
            const auto after = grid.sliceAt(std::nextafter(plane, kInfinity));
            if (k < slices) {
                EXPECT_EQ(at, k);
                EXPECT_EQ(after, k);
            } else {
                EXPECT_EQ(at, std::nullopt);
                EXPECT_EQ(after, std::nullopt);
            }
        }
    }
}

TEST(ClusterGrid, SliceAt_OutsideTheGridIsNone) {
    const ClusterGrid grid = makeClusterGrid({16, 9, 24}, {640, 360}, perspective(45), 0.1, 50);
    EXPECT_EQ(grid.sliceAt(0.0F), 0U);
    EXPECT_EQ(grid.sliceAt(std::numeric_limits<float>::denorm_min()), 0U);
    for (const float depth : {-1.0F, 1e6F, kInfinity, -kInfinity, std::nanf("")}) {
        EXPECT_EQ(grid.sliceAt(depth), std::nullopt) << depth;
    }
}

// The centre of every pixel lies in the cell of the tile that its integer coordinates name.
TEST(ClusterGrid, Tiles_CoverEveryPixelOfAnySize) {
    const view::Size sizes[] = {{1, 1},   {1, 97},      {97, 1},     {17, 33},
                                {16, 16}, {1919, 1079}, {1280, 720}, {4096, 16}};
    const view::GridSize grids[] = {{16, 9, 1}, {15, 15, 1}, {32, 16, 1}, {128, 128, 1}, {1, 1, 1}};
    for (const view::Size& size : sizes) {
        for (const view::GridSize& tiles : grids) {
            const ClusterGrid grid = makeClusterGrid(tiles, size, perspective(60), 0.1, 10);
            ASSERT_LE(grid.usedColumns(), tiles.x);
            ASSERT_LE(grid.usedRows(), tiles.y);
            EXPECT_EQ((size.width_px - 1) / grid.tile_width_px, grid.usedColumns() - 1);
            EXPECT_EQ((size.height_px - 1) / grid.tile_height_px, grid.usedRows() - 1);
            EXPECT_DOUBLE_EQ(grid.columnEdge(0), -grid.half_x);
            EXPECT_DOUBLE_EQ(grid.columnEdge(grid.usedColumns()), grid.half_x);
            EXPECT_DOUBLE_EQ(grid.rowEdge(0), -grid.half_y);
            EXPECT_DOUBLE_EQ(grid.rowEdge(grid.usedRows()), grid.half_y);
            for (uint32_t x = 0; x < size.width_px; ++x) {
                const double centre = (2 * (x + 0.5) / size.width_px - 1) * grid.half_x;
                const uint32_t column = x / grid.tile_width_px;
                ASSERT_GT(centre, grid.columnEdge(column));
                ASSERT_LT(centre, grid.columnEdge(column + 1));
            }
            for (uint32_t y = 0; y < size.height_px; ++y) {
                const double centre = (2 * (y + 0.5) / size.height_px - 1) * grid.half_y;
                const uint32_t row = y / grid.tile_height_px;
                ASSERT_GT(centre, grid.rowEdge(row));
                ASSERT_LT(centre, grid.rowEdge(row + 1));
            }
        }
    }
}

TEST(ClusterGrid, Edges_FollowTheProjection) {
    const ClusterGrid deep = makeClusterGrid({2, 2, 1}, {200, 100}, perspective(90), 0.1, 10);
    EXPECT_NEAR(deep.half_y, 1, 1e-12);
    EXPECT_NEAR(deep.half_x, 2, 1e-12);
    const ClusterGrid flat = makeClusterGrid({2, 2, 1}, {200, 100}, orthographic(3), 0.1, 10);
    EXPECT_DOUBLE_EQ(flat.half_y, 3);
    EXPECT_DOUBLE_EQ(flat.half_x, 6);
}

} // namespace
} // namespace froxel::cluster::testing

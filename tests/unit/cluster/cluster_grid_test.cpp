#include "assign_cases.h"
#include "cluster/cluster_grid.h"

#include <gtest/gtest.h>

namespace froxel::cluster::testing {
namespace {

// The centre of every pixel lies in the cell of the tile that its integer coordinates name.
TEST(ClusterGrid, Tiles_CoverEveryPixelOfAnySize) {
    const settings::Size sizes[] = {{1, 1},   {1, 97},      {97, 1},     {17, 33},
                                    {16, 16}, {1919, 1079}, {1280, 720}, {4096, 16}};
    const settings::GridSize grids[] = {
        {16, 9, 1}, {15, 15, 1}, {32, 16, 1}, {128, 128, 1}, {1, 1, 1}};
    for (const settings::Size& size : sizes) {
        for (const settings::GridSize& tiles : grids) {
            const ClusterGrid grid = makeClusterGrid({tiles}, size, perspective(60), 0.1, 10);
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

TEST(ClusterGrid, ShiftedLens_MovesTheEdges) {
    for (settings::Camera camera : {perspective(90), orthographic(1)}) {
        camera.lens_shift = {0.5, -0.25};
        const ClusterGrid grid = makeClusterGrid({2, 2, 1}, {200, 100}, camera, 0.1, 10);
        EXPECT_NEAR(grid.columnEdge(0), -2 + 1, 1e-12); // right by half of 2
        EXPECT_NEAR(grid.columnEdge(2), 2 + 1, 1e-12);
        EXPECT_NEAR(grid.rowEdge(0), -1 + 0.25, 1e-12); // down, where y points
        EXPECT_NEAR(grid.rowEdge(2), 1 + 0.25, 1e-12);
    }
}

TEST(ClusterGrid, GivenTiles_AreKept) {
    const ClusterGrid grid =
        makeClusterGrid({.size = {3, 2, 1}, .tile_width_px = 40, .tile_height_px = 56}, {100, 100},
                        perspective(45), 0.1, 10);
    EXPECT_EQ(grid.tile_width_px, 40U);
    EXPECT_EQ(grid.tile_height_px, 56U);
    EXPECT_EQ(grid.usedColumns(), 3U);
    EXPECT_EQ(grid.usedRows(), 2U);
}

} // namespace
} // namespace froxel::cluster::testing

// How a view's frustum is cut into clusters: one law for assignment and for shaders.
//
// Memory. The largest grid in the accepted range (settings::kGridXRange and so on) has 4,194,304
// clusters. Its lists' heads take kClusterBytes each, 32 MiB for every frame in flight; the host's
// assigner works with as much again, half for each thread (LightAssigner). kMaxGridBytes is what
// every Vulkan device must be able to bind as one storage buffer.
#pragma once

#include "cluster/slice_law.h"
#include "settings/camera.h"
#include "settings/ranges.h"
#include "settings/settings.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace froxel::cluster {

// A cluster's cell. Perspective: x and y are tangents (x = column * depth). Orthographic: metres.
// y points down the picture (view space's y is up); z is the depth in metres, positive ahead.
struct Cell {
    double x0, x1;
    double y0, y1;
    double z0, z1;
};

inline constexpr uint64_t kClusterBytes = 8; // io::ClusterList
inline constexpr uint64_t kMaxGridBytes = uint64_t{128} << 20U;
static_assert(uint64_t{settings::kGridXRange.max} * settings::kGridYRange.max *
                      settings::kGridZRange.max * kClusterBytes <=
                  kMaxGridBytes,
              "a grid that a viewer can ask for must fit a storage buffer");

// Clusters are numbered x fastest, then y, then z; row 0 is at the top of the picture.
// A pixel's column and row are its integer coordinates divided by the tile's size: the last ones
// may be partial, and columns past the picture (more columns than pixels) stay empty.
// A pixel's slice is the k with plane_depths_m[k] <= depth < plane_depths_m[k + 1]; at or beyond
// the last plane a pixel belongs to no cluster, because no light reaches it.
struct ClusterGrid {
    settings::GridSize size;
    settings::Size image;
    uint32_t tile_width_px = 1;
    uint32_t tile_height_px = 1;
    settings::Projection projection = settings::Projection::kPerspective;
    // Half the picture's size and its middle, as Cell has x and y: tangents or metres. The middle
    // is off 0 where the camera's lens is shifted.
    double half_x = 1;
    double half_y = 1;
    double middle_x = 0;
    double middle_y = 0;
    SliceLaw slice_law;
    std::vector<float> plane_depths_m; // size.z + 1, from 0, strictly ascending; made by the law

    [[nodiscard]] uint32_t clusterCount() const { return size.x * size.y * size.z; }
    [[nodiscard]] uint32_t clusterIndex(uint32_t x, uint32_t y, uint32_t z) const {
        return (z * size.y + y) * size.x + x;
    }
    // Columns and rows that hold pixels.
    [[nodiscard]] uint32_t usedColumns() const;
    [[nodiscard]] uint32_t usedRows() const;
    // None: behind the eye, at or beyond the last plane, or not a number.
    [[nodiscard]] std::optional<uint32_t> sliceAt(float depth_m) const;
    // The edges of columns and rows, as Cell has them; the last used one ends with the picture.
    [[nodiscard]] double columnEdge(uint32_t column) const;
    [[nodiscard]] double rowEdge(uint32_t row) const;
    // (x, y) must be a used column and row.
    [[nodiscard]] Cell cell(uint32_t x, uint32_t y, uint32_t z) const;
};

// How many clusters, and where slices lie.
struct GridShape {
    settings::GridSize size;
    settings::GridLaw law = settings::GridLaw::kLogarithmic;
    // 0: the least that `size` tiles cover the picture with.
    uint32_t tile_width_px = 0;
    uint32_t tile_height_px = 0;
    bool operator==(const GridShape&) const = default;
};

// Slices from grid_near_m to grid_far_m (metres of depth), the first one stretched to the eye. Far
// not beyond near is moved to just beyond it. Sizes must be at least 1; tiles too small
// to cover the picture are enlarged.
[[nodiscard]] ClusterGrid makeClusterGrid(const GridShape& shape,
                                          const settings::Size& image,
                                          const settings::Camera& camera,
                                          double grid_near_m,
                                          double grid_far_m);

} // namespace froxel::cluster

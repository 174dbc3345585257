// How a view's frustum is cut into clusters: one law for assignment and for shaders.
#pragma once

#include "view/camera.h"
#include "view/settings.h"

#include <algorithm>
#include <bit>
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

// A depth's slice by integers: the bits of a positive float grow with it, piecewise linearly in its
// logarithm (at most 6 % off a true logarithmic slice). Assignment and shaders agree to the last
// bit without a table, because nothing here rounds.
struct SliceLaw {
    uint32_t first_bits = 0; // of the grid's near depth; nearer ones are in slice 0
    uint32_t scale = 0;      // slices per step of bits, times 2^(32 + shift)
    uint32_t shift = 0;

    // At or beyond the slice count: behind the last plane. depth_m must not be negative.
    [[nodiscard]] uint32_t sliceOf(float depth_m) const {
        const uint32_t bits = std::max(std::bit_cast<uint32_t>(depth_m), first_bits) - first_bits;
        return static_cast<uint32_t>((uint64_t{bits} * scale) >> (32U + shift));
    }
};

// Clusters are numbered x fastest, then y, then z; row 0 is at the top of the picture.
// A pixel's column and row are its integer coordinates divided by the tile's size: the last ones
// may be partial, and columns past the picture (more columns than pixels) stay empty.
// A pixel's slice is the k with plane_depths_m[k] <= depth < plane_depths_m[k + 1]; at or beyond
// the last plane a pixel belongs to no cluster, because no light reaches it.
struct ClusterGrid {
    view::GridSize size;
    view::Size image;
    uint32_t tile_width_px = 1;
    uint32_t tile_height_px = 1;
    view::Projection projection = view::Projection::kPerspective;
    double half_x = 1; // picture's edge: tangent (perspective) or metres (orthographic)
    double half_y = 1;
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

// Logarithmic slices from grid_near_m to grid_far_m (metres of depth), the first one stretched to
// the eye. Far not beyond near is moved to just beyond it. Sizes must be at least 1.
[[nodiscard]] ClusterGrid makeClusterGrid(const view::GridSize& size,
                                          const view::Size& image,
                                          const view::Camera& camera,
                                          double grid_near_m,
                                          double grid_far_m);

} // namespace froxel::cluster

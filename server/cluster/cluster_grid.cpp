#include "cluster/cluster_grid.h"

#include "core/assert.h"

#include <algorithm>
#include <cmath>

namespace froxel::cluster {
namespace {

// Depths of a grid stay within what a float's square and reciprocal can hold.
constexpr double kNearest_m = 1e-9;
constexpr double kFarthest_m = 1e18;

uint32_t ceilDivide(uint32_t value, uint32_t divisor) {
    return value / divisor + (value % divisor != 0 ? 1U : 0U);
}

// Tile borders are whole pixels; an unshifted picture's centre is at 0.
double edge(uint32_t tile, uint32_t tile_px, uint32_t image_px, double half, double middle) {
    const uint64_t pixel = std::min<uint64_t>(uint64_t{tile} * tile_px, image_px);
    return (2.0 * static_cast<double>(pixel) / image_px - 1.0) * half + middle;
}

} // namespace

uint32_t ClusterGrid::usedColumns() const {
    return ceilDivide(image.width_px, tile_width_px);
}

uint32_t ClusterGrid::usedRows() const {
    return ceilDivide(image.height_px, tile_height_px);
}

std::optional<uint32_t> ClusterGrid::sliceAt(float depth_m) const {
    if (!(depth_m >= 0)) {
        return std::nullopt;
    }
    const uint32_t slice = slice_law.sliceOf(depth_m);
    return slice < size.z ? std::optional(slice) : std::nullopt;
}

double ClusterGrid::columnEdge(uint32_t column) const {
    return edge(column, tile_width_px, image.width_px, half_x, middle_x);
}

double ClusterGrid::rowEdge(uint32_t row) const {
    return edge(row, tile_height_px, image.height_px, half_y, middle_y);
}

Cell ClusterGrid::cell(uint32_t x, uint32_t y, uint32_t z) const {
    return {columnEdge(x),
            columnEdge(x + 1),
            rowEdge(y),
            rowEdge(y + 1),
            static_cast<double>(plane_depths_m[z]),
            static_cast<double>(plane_depths_m[z + 1])};
}

ClusterGrid makeClusterGrid(const GridShape& shape,
                            const settings::Size& image,
                            const settings::Camera& camera,
                            double grid_near_m,
                            double grid_far_m) {
    const settings::GridSize& size = shape.size;
    FROXEL_ASSERT(size.x > 0 && size.y > 0 && size.z > 0, "a grid needs a cluster");
    FROXEL_ASSERT(image.width_px > 0 && image.height_px > 0, "a picture needs a pixel");
    FROXEL_ASSERT(grid_near_m > 0 && std::isfinite(grid_far_m), "depths must be finite, near > 0");
    ClusterGrid grid;
    grid.size = size;
    grid.image = image;
    grid.tile_width_px = std::max(shape.tile_width_px, ceilDivide(image.width_px, size.x));
    grid.tile_height_px = std::max(shape.tile_height_px, ceilDivide(image.height_px, size.y));
    grid.projection = camera.projection;
    grid.half_y = camera.projection == settings::Projection::kPerspective
                      ? std::tan(camera.yfov_rad * 0.5)
                      : camera.half_height_m;
    grid.half_x = grid.half_y * image.width_px / image.height_px;
    grid.middle_x = camera.lens_shift.x * grid.half_x;
    grid.middle_y = -camera.lens_shift.y * grid.half_y; // y points down here
    const double near_m = std::clamp(grid_near_m, kNearest_m, kFarthest_m);
    const double far_m = std::clamp(grid_far_m, near_m, kFarthest_m);
    grid.slice_law = makeSliceLaw(shape.law, size.z, near_m, far_m);
    grid.plane_depths_m.push_back(0.0F);
    for (uint32_t k = 1; k <= size.z; ++k) {
        grid.plane_depths_m.push_back(planeDepth(grid.slice_law, k));
    }
    return grid;
}

} // namespace froxel::cluster

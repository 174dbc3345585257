#include "cluster/cluster_grid.h"

#include "core/assert.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace froxel::cluster {
namespace {

// Depths of a grid stay within what a float's square and reciprocal can hold.
constexpr double kNearest_m = 1e-9;
constexpr double kFarthest_m = 1e18;

uint32_t ceilDivide(uint32_t value, uint32_t divisor) {
    return value / divisor + (value % divisor != 0 ? 1U : 0U);
}

// Depth where slice k begins: the smallest float that SliceLaw puts into k.
float planeDepth(const SliceLaw& law, uint32_t k) {
    const uint64_t steps = ((uint64_t{k} << (32U + law.shift)) + law.scale - 1) / law.scale;
    return std::bit_cast<float>(static_cast<uint32_t>(law.first_bits + steps));
}

// The law under which the last of `slices` ends at far_m or just beyond.
SliceLaw sliceLaw(uint32_t slices, double near_m, double far_m) {
    const auto first = std::bit_cast<uint32_t>(static_cast<float>(near_m));
    auto far_f = static_cast<float>(far_m);
    if (static_cast<double>(far_f) < far_m) {
        far_f = std::nextafter(far_f, std::numeric_limits<float>::infinity());
    }
    // Nearly equal near and far must still give every slice a float of its own.
    const uint32_t span = std::max(std::bit_cast<uint32_t>(far_f) - first, slices + 1U);
    // As many bits of scale as 32 can hold: slices << shift stays below span.
    uint32_t shift = 0;
    while ((uint64_t{slices} << (shift + 1U)) < span) {
        ++shift;
    }
    return {first, static_cast<uint32_t>((uint64_t{slices} << (32U + shift)) / span), shift};
}

// Tile borders are whole pixels; the picture's centre is at 0.
double edge(uint32_t tile, uint32_t tile_px, uint32_t image_px, double half) {
    const uint64_t pixel = std::min<uint64_t>(uint64_t{tile} * tile_px, image_px);
    return (2.0 * static_cast<double>(pixel) / image_px - 1.0) * half;
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
    return edge(column, tile_width_px, image.width_px, half_x);
}

double ClusterGrid::rowEdge(uint32_t row) const {
    return edge(row, tile_height_px, image.height_px, half_y);
}

Cell ClusterGrid::cell(uint32_t x, uint32_t y, uint32_t z) const {
    return {columnEdge(x),
            columnEdge(x + 1),
            rowEdge(y),
            rowEdge(y + 1),
            static_cast<double>(plane_depths_m[z]),
            static_cast<double>(plane_depths_m[z + 1])};
}

ClusterGrid makeClusterGrid(const view::GridSize& size,
                            const view::Size& image,
                            const view::Camera& camera,
                            double grid_near_m,
                            double grid_far_m) {
    FROXEL_ASSERT(size.x > 0 && size.y > 0 && size.z > 0, "a grid needs a cluster");
    FROXEL_ASSERT(image.width_px > 0 && image.height_px > 0, "a picture needs a pixel");
    FROXEL_ASSERT(grid_near_m > 0 && std::isfinite(grid_far_m), "depths must be finite, near > 0");
    ClusterGrid grid;
    grid.size = size;
    grid.image = image;
    grid.tile_width_px = ceilDivide(image.width_px, size.x);
    grid.tile_height_px = ceilDivide(image.height_px, size.y);
    grid.projection = camera.projection;
    grid.half_y = camera.projection == view::Projection::kPerspective
                      ? std::tan(camera.yfov_rad * 0.5)
                      : camera.half_height_m;
    grid.half_x = grid.half_y * image.width_px / image.height_px;
    const double near_m = std::clamp(grid_near_m, kNearest_m, kFarthest_m);
    const double far_m = std::clamp(grid_far_m, near_m, kFarthest_m);
    grid.slice_law = sliceLaw(size.z, near_m, far_m);
    grid.plane_depths_m.push_back(0.0F);
    for (uint32_t k = 1; k <= size.z; ++k) {
        grid.plane_depths_m.push_back(planeDepth(grid.slice_law, k));
    }
    return grid;
}

} // namespace froxel::cluster

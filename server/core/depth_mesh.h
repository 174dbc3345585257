// A mesh over a picture with the depth of what it shows: enough to draw the picture from a camera
// near its own.
#pragma once

#include <cstdint>

namespace froxel {

// Vertices are at the centres of every so manieth pixel, from the first on, and of the last one: of
// meshes as they are drawn.
inline constexpr uint32_t kDepthCell_px = 8;

struct DepthMeshSize {
    uint32_t columns = 0; // of vertices
    uint32_t rows = 0;

    constexpr DepthMeshSize() = default;
    constexpr DepthMeshSize(uint32_t width_px, uint32_t height_px, uint32_t cell_px = kDepthCell_px)
        : columns(verticesAlong(width_px, cell_px)), rows(verticesAlong(height_px, cell_px)) {}
    [[nodiscard]] constexpr uint32_t vertexCount() const { return columns * rows; }
    bool operator==(const DepthMeshSize&) const = default;

  private:
    // At least one pixel.
    static constexpr uint32_t verticesAlong(uint32_t side_px, uint32_t cell_px) {
        return (side_px - 1 + cell_px - 1) / cell_px + 1;
    }
};
static_assert(DepthMeshSize(1280, 720) == DepthMeshSize(1281, 721));
static_assert(DepthMeshSize(1280, 720).columns == 161 && DepthMeshSize(1280, 720).rows == 91);
static_assert(DepthMeshSize(1, 2).columns == 1 && DepthMeshSize(1, 2).rows == 2);

} // namespace froxel

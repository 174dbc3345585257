// How many (light, pixel) pairs a part of a picture may hold, from what its lists hold.
#pragma once

#include "cluster/cluster_grid.h"
#include "cluster/light_assigner.h"
#include "gpu/vulkan.h"

#include <cstdint>
#include <span>
#include <vector>

namespace froxel::render {

// A pixel's slice is not known before it is drawn, so each counts with the longest list of its
// tile: never less than what is evaluated.
class PairBound {
  public:
    PairBound() = default;
    // Every pixel loops over so many lights.
    static PairBound uniform(uint64_t lights_each);
    // From the longest list of each tile, row by row, of a grid's size.x * size.y.
    static PairBound tiles(const cluster::ClusterGrid& grid, std::span<const uint32_t> longest);
    // From the lists themselves.
    static PairBound lists(const cluster::ClusterGrid& grid, const cluster::LightLists& lists);

    // Pixels of the region times the lights that each may loop over.
    [[nodiscard]] double pairs(const vk::Rect2D& region) const;
    // Of any pixel.
    [[nodiscard]] uint64_t longest() const { return longest_; }

  private:
    uint32_t tile_width_px_ = 0; // 0: uniform
    uint32_t tile_height_px_ = 0;
    uint32_t columns_ = 0;
    std::vector<uint32_t> tiles_;
    uint64_t longest_ = 0;
};

} // namespace froxel::render

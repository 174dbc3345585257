#include "render/lists/pair_bound.h"

#include "core/assert.h"

#include <algorithm>

namespace froxel::render {

PairBound PairBound::uniform(uint64_t lights_each) {
    PairBound bound;
    bound.longest_ = lights_each;
    return bound;
}

PairBound PairBound::tiles(const cluster::ClusterGrid& grid, std::span<const uint32_t> longest) {
    FROXEL_ASSERT(longest.size() == size_t{grid.size.x} * grid.size.y, "a length for each tile");
    PairBound bound;
    bound.tile_width_px_ = grid.tile_width_px;
    bound.tile_height_px_ = grid.tile_height_px;
    bound.columns_ = grid.size.x;
    bound.tiles_.assign(longest.begin(), longest.end());
    bound.longest_ = longest.empty() ? 0 : *std::max_element(longest.begin(), longest.end());
    return bound;
}

PairBound PairBound::lists(const cluster::ClusterGrid& grid, const cluster::LightLists& lists) {
    const size_t tile_count = size_t{grid.size.x} * grid.size.y;
    std::vector<uint32_t> longest(tile_count, 0);
    for (size_t cluster = 0; cluster < lists.clusters.size(); ++cluster) {
        uint32_t& tile = longest[cluster % tile_count]; // x fastest, then y, then z
        tile = std::max(tile, lists.clusters[cluster].count);
    }
    return tiles(grid, longest);
}

double PairBound::pairs(const vk::Rect2D& region) const {
    if (tile_width_px_ == 0) {
        return static_cast<double>(region.extent.width) * region.extent.height *
               static_cast<double>(longest_);
    }
    const auto left = static_cast<uint32_t>(region.offset.x);
    const auto top = static_cast<uint32_t>(region.offset.y);
    const uint32_t right = left + region.extent.width;
    const uint32_t bottom = top + region.extent.height;
    // Of [begin, end), what lies in the tile of this place.
    const auto shared = [](uint32_t begin, uint32_t end, uint32_t tile, uint32_t side) {
        return std::min(end, (tile + 1) * side) - std::max(begin, tile * side);
    };
    double sum = 0;
    for (uint32_t y = top / tile_height_px_; y * tile_height_px_ < bottom; ++y) {
        for (uint32_t x = left / tile_width_px_; x * tile_width_px_ < right; ++x) {
            sum += static_cast<double>(shared(left, right, x, tile_width_px_)) *
                   shared(top, bottom, y, tile_height_px_) * tiles_[y * columns_ + x];
        }
    }
    return sum;
}

} // namespace froxel::render

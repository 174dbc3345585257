// A view's shadow maps on the host, for tests.
#pragma once

#include <cstdint>
#include <vector>

namespace froxel::render {

struct ShadowAtlas {
    uint32_t size_px = 0;      // of a tile
    uint32_t width_px = 0;     // of the atlas
    std::vector<float> depths; // [height][width]: the reach's thousandth over the distance; 0: none
    std::vector<uint32_t> shadow_of_light; // of each local light: into first_tiles; io::kNoShadow
    std::vector<uint32_t> first_tiles;     // of each light with maps
};

} // namespace froxel::render

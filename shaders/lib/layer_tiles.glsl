// Which tiles of the picture, those of workgroups over the screen, a layer has pixels in: a
// dispatch of four words for each layer, then a list of tiles for each.
#include "interface/visibility_io.h"

layout(set = 2, binding = FROXEL_TILES_BINDING, scalar) buffer TileBlock { uint layer_tiles[]; };

uint tileCount() {
    uvec2 size = uvec2(frame.camera.width_px, frame.camera.height_px);
    uvec2 tiles = (size + kScreenGroup - 1u) / kScreenGroup;
    return tiles.x * tiles.y;
}

uvec2 layerTile(uint layer, uint i) {
    uint tile = layer_tiles[kTileHeadWords + layer * tileCount() + i];
    return uvec2(tile & 0xffffu, tile >> 16);
}

void listTile(uint layer, uvec2 tile) {
    uint i = atomicAdd(layer_tiles[4u * layer], 1u);
    layer_tiles[kTileHeadWords + layer * tileCount() + i] = tile.x | (tile.y << 16);
}

// Triangle ids rastered in compute: what recordCompact and recordVisibility do elsewhere. No
// barrier is here. Of surfaces that transmit light they keep several layers of a pixel, and all are
// parts of the pass that finds those.
#pragma once

#include "render/frame/frame_context.h"

namespace froxel::render {

void recordRasterClear(const FrameContext& frame); // clears words and batches
// Writes the list of visible meshlets; culls: not of all.
void recordRasterCull(const FrameContext& frame, bool culls);
// Of which each batch is drawn by two passes, one batch after another.
[[nodiscard]] uint32_t rasterBatchCount(const FrameContext& frame);
// Of a batch that follows others: keeps what those do not hide. Reads the farthest depths.
void recordRasterHidden(const FrameContext& frame, uint32_t batch);
// Reads the list; writes words and large triangles.
void recordRasterMeshlets(const FrameContext& frame, uint32_t batch);
// Reads large triangles; writes words.
void recordRasterBlocks(const FrameContext& frame, uint32_t batch);
// Reads words; writes the farthest depths.
void recordRasterFar(const FrameContext& frame, uint32_t batch);
void recordRasterUnpack(const FrameContext& frame); // reads words; writes depth and ids
// Of several layers: drops those that are hidden and lists tiles of the others. Reads words and
// solid depth of a region; writes words and tiles.
void recordLayerTiles(const FrameContext& frame, const vk::Rect2D& region);
// And writes the depth of the nearest layers, everywhere: there is none outside of the region's
// rows.
void recordLayerTilesAndDepth(const FrameContext& frame, const vk::Rect2D& region);
void recordRasterSpoil(const FrameContext& frame); // for tests: overwrites words

// Depth to where the rasteriser tests it, in two copies by way of the words' buffer.
void recordDepthOut(const FrameContext& frame); // reads depth
void recordDepthIn(const FrameContext& frame);  // writes the rasteriser's

} // namespace froxel::render

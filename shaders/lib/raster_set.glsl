// Set 2, continued: what the passes that raster ids in compute share. words: depth's bits above the
// id, so that of what covers a pixel the nearest has the largest word, and of equal depths the last
// of the scene. With FROXEL_PEELED there are as many pictures of them as a pixel may have layers,
// the nearest first.
#include "interface/raster_io.h"

layout(set = 2, binding = 15, scalar) buffer WordBlock { uint64_t words[]; };
layout(set = 2, binding = 16, scalar) buffer RasterBatchBlock { RasterBatch batches[]; };
layout(set = 2, binding = 17, scalar) buffer VisibleBlock { uint visible_meshlets[]; };
layout(set = 2, binding = 18, scalar) buffer LargeBlock { LargeTriangle large_triangles[]; };
layout(set = 2, binding = 23, scalar) readonly buffer WordsBlock { uint meshlet_words[]; };

#ifdef FROXEL_PEELED
uint layerCount() { return batches[0].layer_count; }
#endif

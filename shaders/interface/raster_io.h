// Triangle ids rastered in compute: sizes, and what its passes hand on (scalar block layout).
#ifndef FROXEL_INTERFACE_RASTER_IO_H
#define FROXEL_INTERFACE_RASTER_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

// Screen coordinates are integers of 1/256 of a pixel from the picture's top left corner. Triangles
// are clipped to a guard band, so that edge functions fit 64 bits and their change over a block 32.
FROXEL_CONST uint kSubpixelBits = 8U;
FROXEL_CONST float kGuardPx = 8192.0F; // from the picture's middle

FROXEL_CONST uint kRasterGroup = 128U; // invocations a meshlet
// Where several layers are kept: an invocation waits for what its pixels held before.
FROXEL_CONST uint kPeeledGroup = 512U;
FROXEL_CONST uint kRasterTiny = 4U;           // pixels of a box that one of them draws by itself
FROXEL_CONST uint kRasterSmall = 16U;         // pixels a side of what a meshlet's workgroup draws
FROXEL_CONST uint kRasterBlock = 32U;         // pixels a side of the blocks of larger triangles
FROXEL_CONST uint kRasterBlockGroup = 64U;    // invocations a block
FROXEL_CONST uint kRasterBlockGroups = 4096U; // workgroups, which take runs of blocks in turns
FROXEL_CONST uint kRasterHiddenGroup = 64U;   // invocations, which take meshlets in turns
FROXEL_CONST uint kRasterRun = 8U;            // blocks

// RasterBatch::large: blocks in the low bits, large triangles above.
FROXEL_CONST uint kRasterBlockBits = 40U;
FROXEL_CONST uint kRasterMostTriangles = 1U << 24; // of a batch, so that neither part overflows
FROXEL_CONST uint kRasterMostBatches = 512U;
// Pixels a side of blocks whose farthest depth is known to later batches.
FROXEL_CONST uint kFarFine = 8U;
FROXEL_CONST uint kFarCoarse = 64U;

// VkDispatchIndirectCommand.
struct Dispatch {
    uint x;
    uint y;
    uint z;
};
FROXEL_SIZE_ASSERT(Dispatch, 12);

// Visible meshlets that are drawn together, since their large triangles have room together.
struct RasterBatch {
    Dispatch listed; // visible meshlets; drawn by the first batch, a workgroup each
    Dispatch drawn;  // by a later one: those of them that earlier batches do not hide
    Dispatch others; // of all other passes: kRasterBlockGroups, or none where none is listed
    uint most;       // meshlets of a batch
    uint64_t large;
    uint first;         // of visible_meshlets[], of those listed
    uint first_drawn;   // of those drawn
    uint listed_of_all; // of the first: those of all batches
    uint layer_count;   // of each pixel that are kept; 0: the nearest surface alone
};
FROXEL_SIZE_ASSERT(RasterBatch, 64);

// A triangle that is drawn in blocks.
struct LargeTriangle {
    uint64_t first_block; // of the frame's
    uint id;
    uint box; // x | y << 12 of its first pixel, blocks a row << 24
};
FROXEL_SIZE_ASSERT(LargeTriangle, 16);

FROXEL_IO_NAMESPACE_END

#endif

// What the pass that makes the depth mesh is told, as push constants (scalar block layout).
#ifndef FROXEL_INTERFACE_DEPTH_MESH_IO_H
#define FROXEL_INTERFACE_DEPTH_MESH_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

struct DepthMeshFrame {
    uint columns; // of vertices
    uint rows;
    uint cell_px; // from one to the next
    uint samples; // drawn across a pixel and down it
};
FROXEL_SIZE_ASSERT(DepthMeshFrame, 16);

FROXEL_IO_NAMESPACE_END

#endif

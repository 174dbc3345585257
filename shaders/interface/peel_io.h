// What tells triangles apart while blended surfaces are peeled.
#ifndef FROXEL_INTERFACE_PEEL_IO_H
#define FROXEL_INTERFACE_PEEL_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

// Push constants of a draw.
struct PeelDraw {
    uint first_triangle; // of the frame's blended triangles, in the order drawn
    uint layer;          // 0: the nearest
};
FROXEL_SIZE_ASSERT(PeelDraw, 8);

FROXEL_IO_NAMESPACE_END

#endif

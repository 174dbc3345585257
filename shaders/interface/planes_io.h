// Where a picture's planes lie: luma, then blue's and red's difference, in words of four samples
// (scalar block layout).
#ifndef FROXEL_INTERFACE_PLANES_IO_H
#define FROXEL_INTERFACE_PLANES_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

FROXEL_CONST uint kPlanesGroup = 256U; // invocations of a workgroup, a word of each plane

// Push constants.
struct PlanesPicture {
    uint width_px;
    uint height_px;
    uint luma_row; // words
    uint chroma_row;
    uint chroma_height;
};

FROXEL_IO_NAMESPACE_END

#endif

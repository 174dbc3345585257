// The one colour map of heat maps, in integers: the same bits in C++ and in GLSL. Viridis (S. van
// der Walt and N. Smith, matplotlib 2015, CC0) at nine stops; its lightness grows evenly, for all
// kinds of sight. The middle stop is a step greener, so that each position has a colour of its own.
#ifndef FROXEL_INTERFACE_HEAT_MAP_H
#define FROXEL_INTERFACE_HEAT_MAP_H

#include "compat.h"

#ifdef __cplusplus
#define FROXEL_HEAT_FUNCTION [[nodiscard]] inline
#else
#define FROXEL_HEAT_FUNCTION
#endif

FROXEL_IO_NAMESPACE_BEGIN

FROXEL_CONST uint kHeatStops = 9U;
FROXEL_CONST uint kHeatTop = 256U; // of positions on the map: 32 from stop to stop

// 0xRRGGBB.
FROXEL_CONST uint kHeatColors[9] =
#ifdef __cplusplus
    {0x440154U, 0x472d7bU, 0x3b528bU, 0x2c728eU, 0x21928cU,
     0x28ae80U, 0x5ec962U, 0xaddc30U, 0xfde725U};
#else
    uint[9](0x440154U, 0x472d7bU, 0x3b528bU, 0x2c728eU, 0x21928cU, 0x28ae80U, 0x5ec962U, 0xaddc30U,
            0xfde725U);
#endif

FROXEL_HEAT_FUNCTION uint heatChannel(uint a, uint b, uint shift, uint share) {
    return (((a >> shift) & 255U) * (32U - share) + ((b >> shift) & 255U) * share + 16U) >> 5;
}

// RGBA8, red in the lowest byte, of a position from 0 to kHeatTop.
FROXEL_HEAT_FUNCTION uint heatColor(uint position) {
    uint stop = position >= kHeatTop ? kHeatStops - 2U : position >> 5;
    uint share = position >= kHeatTop ? 32U : position & 31U;
    uint a = kHeatColors[stop];
    uint b = kHeatColors[stop + 1U];
    return heatChannel(a, b, 16U, share) | (heatChannel(a, b, 8U, share) << 8) |
           (heatChannel(a, b, 0U, share) << 16) | 0xff000000U;
}

// Of a count on a scale from 0 to `most` > 0, at most 2^24 - 1: `most` and more are the top.
FROXEL_HEAT_FUNCTION uint heatPosition(uint count, uint most) {
    return count >= most ? kHeatTop : (count * kHeatTop) / most;
}

FROXEL_IO_NAMESPACE_END

#endif

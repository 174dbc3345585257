// Counters of light-pixel pairs, 64 bits in two words (scalar block layout).
#ifndef FROXEL_INTERFACE_PAIRS_IO_H
#define FROXEL_INTERFACE_PAIRS_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

struct PairCounts {
    uint evaluated_low;
    uint evaluated_high;
    uint contributing_low;
    uint contributing_high;
};
FROXEL_SIZE_ASSERT(PairCounts, 16);

FROXEL_IO_NAMESPACE_END

#endif

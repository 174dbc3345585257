// What metering's shaders and the host agree on: shaders/exposure_histogram.comp.
#ifndef FROXEL_INTERFACE_EXPOSURE_IO_H
#define FROXEL_INTERFACE_EXPOSURE_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

// The histogram's bins: luminance from 2^-16 to 2^16, each octave in eight equal steps. So a bin is
// a float's exponent and the three leading bits of its mantissa, and every device counts alike.
FROXEL_CONST uint kMeterBins = 256U;
FROXEL_CONST uint kMeterBinShift = 20U; // bits of a float below those
FROXEL_CONST uint kMeterFirst = 888U;   // (127 - 16) * 8: of 2^-16

FROXEL_CONST uint kMeterPixels = 4U; // that an invocation counts, across and down

FROXEL_IO_NAMESPACE_END

#endif

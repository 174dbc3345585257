// How the G-buffer holds normal and position: fields of the output flags (settings::GbufferLayout).
#ifndef FROXEL_INTERFACE_GBUFFER_IO_H
#define FROXEL_INTERFACE_GBUFFER_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

FROXEL_CONST uint kOutputNormalShift = 16U;   // 3 bits: kNormal*
FROXEL_CONST uint kOutputPositionShift = 19U; // 2 bits: kPosition*
FROXEL_CONST uint kOutputEmissionShift = 21U; // 7 bits: the power of 2 that emission is over
// The second target also has a word of what dielectrics reflect: f0 (gamma 2) and f90.
FROXEL_CONST uint kOutputSpecular = 1U << 31;

FROXEL_CONST float kMostStoredEmission = 65408.0F; // RGB9E5

// settings::NormalEncoding, in its order.
FROXEL_CONST uint kNormalOct16 = 0U;
FROXEL_CONST uint kNormalOct12 = 1U;
FROXEL_CONST uint kNormalOct10 = 2U;
FROXEL_CONST uint kNormalOct8 = 3U;
FROXEL_CONST uint kNormalXyz16 = 4U;
FROXEL_CONST uint kNormalXy16 = 5U;
FROXEL_CONST uint kNormalSpheremap16 = 6U;

// settings::PositionSource, in its order.
FROXEL_CONST uint kPositionDepth = 0U;
FROXEL_CONST uint kPositionStoredDepth = 1U;
FROXEL_CONST uint kPositionFp32 = 2U;
FROXEL_CONST uint kPositionFp16 = 3U;

FROXEL_IO_NAMESPACE_END

#endif

// What the passes that make a JPEG share (scalar block layout).
#ifndef FROXEL_INTERFACE_JPEG_IO_H
#define FROXEL_INTERFACE_JPEG_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

FROXEL_CONST uint kJpegBlockSize = 64U;    // coefficients of a block
FROXEL_CONST uint kJpegLanes = 8U;         // invocations a block: one a row, or a column
FROXEL_CONST uint kJpegGroupBlocks = 24U;  // of a workgroup: 4 units of 4:2:0, 8 of 4:4:4
FROXEL_CONST uint kJpegGroup = 192U;       // its invocations
FROXEL_CONST uint kJpegBlockWords = 52U;   // a block's code at most: 64 codes of 26 bits
FROXEL_CONST uint kJpegGroupWords = 1248U; // and a workgroup's
FROXEL_CONST uint kJpegSumGroup = 512U;    // invocations of the workgroup that places runs
FROXEL_CONST uint kJpegStuffGroup = 64U;   // of one that stuffs, four bytes each at a time
FROXEL_CONST uint kJpegAlignments = 8U;    // bits of a byte at which a run may begin

// A coefficient of the transform -> what is coded: (|c| + correction) * reciprocal >> shift.
struct JpegDivisor {
    uint reciprocal;
    uint correction;
    uint shift;
    uint place; // in the scan
};
FROXEL_SIZE_ASSERT(JpegDivisor, 16);

// Of luma, and of chroma. A code: its length << 16 | its bits.
struct JpegTables {
    JpegDivisor divisors[kJpegBlockSize]; // by rows
    uint dc_codes[16];
    uint ac_codes[256];
};

// Of one picture; push constants.
struct JpegPicture {
    uint width_px;
    uint height_px;
    uint units_across; // coded units: 16 x 16 pixels of 4:2:0, else 8 x 8
    uint unit_count;
    uint run_count;  // of units, a workgroup each
    uint scan_at;    // the scan's first byte in file[], a multiple of 4
    uint scan_bytes; // that there is room for
};

// The codes of a run of units, of at least 8 bits. By the first pass:
struct JpegRun {
    uint bits;
    uint leading_ones;                // at most 7
    uint trailing_ones;               // likewise
    uint full_bytes[kJpegAlignments]; // bytes FF wholly in it, if its bit 0, 1, ... begins a byte
};
FROXEL_SIZE_ASSERT(JpegRun, 44);

// By the second: where the run begins in the scan. Behind the last run: where the scan ends.
struct JpegPlace {
    uint bit;
    uint stuffed; // bytes, behind those bytes FF that begin before the run
};
FROXEL_SIZE_ASSERT(JpegPlace, 8);

FROXEL_IO_NAMESPACE_END

#endif

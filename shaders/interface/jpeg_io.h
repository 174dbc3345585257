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
FROXEL_CONST uint kJpegChunk = 256U;       // invocations of a workgroup that stuffs, a word each
FROXEL_CONST uint kJpegChunkBytes = 1024U;

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
    uint chunk_sums; // where sums[] has those of chunks, behind those of workgroups
    uint scan_at;    // the scan's first byte in file[], a multiple of 4
    uint scan_bytes; // that there is room for
};

struct JpegDispatch {
    uint x;
    uint y;
    uint z;
};

// Of one picture on its way; zero before it.
struct JpegState {
    JpegDispatch count; // of the passes over chunks
    JpegDispatch stuff;
    uint code_bits;
    uint done[2]; // workgroups, of either pass that adds up
};

FROXEL_IO_NAMESPACE_END

#endif

// A JPEG, second pass, one workgroup: where in the scan each run of codes begins, and how many
// bytes are stuffed before it.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interface/jpeg_io.h"
layout(local_size_x = kJpegSumGroup) in;
#include "lib/jpeg.glsl"

// Bytes FF that begin in a run, whose first bit is this one of the scan. Its last byte may reach
// into the next run, or to the scan's end, behind which there are 1s.
uint countFullBytes(uint index, uint bit) {
    JpegRun run = runs[index];
    uint first = -bit & 7u; // where a byte begins
    uint over = (run.bits - first) & 7u;
    bool ends_full =
        over > 0u && run.trailing_ones >= over &&
        (index + 1u == picture.run_count || runs[index + 1u].leading_ones >= 8u - over);
    return run.full_bytes[first] + (ends_full ? 1u : 0u);
}

void main() {
    uint count = picture.run_count;
    uint each = (count + kJpegSumGroup - 1u) / kJpegSumGroup;
    uint begin = min(gl_LocalInvocationIndex * each, count);
    uint end = min(begin + each, count);
    uint own_bits = 0u;
    for (uint i = begin; i < end; ++i) {
        own_bits += runs[i].bits;
    }
    uint all_bits;
    uint first_bit = scanGroup(own_bits, all_bits);

    uint own_stuffed = 0u;
    uint bit = first_bit;
    for (uint i = begin; i < end; ++i) {
        own_stuffed += countFullBytes(i, bit);
        bit += runs[i].bits;
    }
    uint all_stuffed;
    uint stuffed = scanGroup(own_stuffed, all_stuffed);
    bit = first_bit;
    for (uint i = begin; i < end; ++i) {
        places[i] = JpegPlace(bit, stuffed);
        stuffed += countFullBytes(i, bit);
        bit += runs[i].bits;
    }

    if (gl_LocalInvocationIndex == 0u) {
        places[count] = JpegPlace(all_bits, all_stuffed);
        // The host reads how long the scan is with its end; 0: there is no room for it.
        uint bytes = (all_bits + 7u) / 8u + all_stuffed + 2u;
        file[0] = bytes <= picture.scan_bytes ? bytes : 0u;
    }
}

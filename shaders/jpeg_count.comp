// A JPEG, second pass: counts the scan's bytes FF, behind each of which a 0 is stuffed. The last
// workgroup finds out where in the file each chunk begins, and how long that is.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interface/jpeg_io.h"
layout(local_size_x = kJpegChunk) in;
#include "lib/jpeg.glsl"
#include "lib/jpeg_scan.glsl"

shared uint stuffed;

// The host reads how long the scan is with its end; 0: there is no room for it.
void planFile(uint code_bytes, uint stuffed_bytes) {
    uint bytes = code_bytes + stuffed_bytes + 2u;
    bool fits = bytes <= picture.scan_bytes;
    file[0] = fits ? bytes : 0u;
    state.stuff = JpegDispatch(fits ? state.count.x : 0u, 1u, 1u);
}

void main() {
    uint self = gl_LocalInvocationIndex;
    if (self == 0u) {
        stuffed = 0u;
    }
    barrier();
    uint own = countStuffed(gl_WorkGroupID.x * kJpegChunk + self);
    if (own > 0u) {
        atomicAdd(stuffed, own);
    }
    barrier();
    if (self == 0u) {
        sums[picture.chunk_sums + gl_WorkGroupID.x] = stuffed;
    }
    if (isLastGroup(1u)) {
        uint stuffed_bytes = addUp(picture.chunk_sums, gl_NumWorkGroups.x);
        if (self == 0u) {
            planFile(scanBytes(), stuffed_bytes);
        }
    }
}

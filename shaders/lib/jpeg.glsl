// What the passes of a JPEG have in common. The layout of the workgroup is declared before.
#include "interface/jpeg_io.h"
#include "lib/group_scan.glsl"

layout(constant_id = 0) const uint kSampling = 2; // luma samples a chroma sample, each way
layout(constant_id = 1) const bool kFast = true;  // which transform

layout(set = 0, binding = 0, scalar) readonly buffer PixelBlock { uint pixels[]; };
layout(set = 0, binding = 1, scalar) readonly buffer TableBlock { JpegTables tables[2]; };
layout(set = 0, binding = 2, scalar) coherent buffer StateBlock { JpegState state; };
// Of workgroups, in bits of code, and of chunks, in stuffed bytes: each its own until the last of
// the pass makes of them what those before it come to, and behind them what all do.
layout(set = 0, binding = 3, scalar) coherent buffer SumBlock { uint sums[]; };
layout(set = 0, binding = 4, scalar) buffer CodeBlock { uint codes[]; }; // by workgroup
layout(set = 0, binding = 5, scalar) writeonly buffer FileBlock { uint file[]; };
layout(push_constant, scalar) uniform PictureBlock { JpegPicture picture; };

const uint kUnitBlocks = kSampling * kSampling + 2u;
const uint kGroupUnits = kJpegGroupBlocks / kUnitBlocks;

shared bool is_last;

// Whether all other workgroups of the pass have stored what they store. All must call.
bool isLastGroup(uint pass) {
    memoryBarrierBuffer();
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        is_last = atomicAdd(state.done[pass], 1u) == gl_NumWorkGroups.x - 1u;
    }
    barrier();
    memoryBarrierBuffer();
    return is_last;
}

// sums[first ..] of `count` become what those before them come to; what all do is behind them and
// returned. All of the last workgroup must call.
uint addUp(uint first, uint count) {
    uint each = (count + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
    uint begin = min(gl_LocalInvocationIndex * each, count);
    uint end = min(begin + each, count);
    uint own = 0u;
    for (uint i = begin; i < end; ++i) {
        own += sums[first + i];
    }
    uint total;
    uint before = scanGroup(own, total);
    for (uint i = begin; i < end; ++i) {
        uint sum = sums[first + i];
        sums[first + i] = before;
        before += sum;
    }
    if (gl_LocalInvocationIndex == 0u) {
        sums[first + count] = total;
    }
    return total;
}

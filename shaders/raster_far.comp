// The farthest depths of blocks of pixels, of what earlier batches drew; a workgroup takes coarse
// blocks in turns, an invocation a fine one of it.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require
#define FROXEL_CAMERA_ALONE
#include "lib/frame.glsl"
#include "lib/raster_set.glsl"
#include "lib/raster_far.glsl"

const uint kFineOfCoarse = kFarCoarse / kFarFine; // along each side

layout(local_size_x = kFineOfCoarse * kFineOfCoarse) in;

const float kNoPixel = 2.0; // nearer than any: blocks beyond the picture's edge hide all

shared float farthest[kFineOfCoarse * kFineOfCoarse];

float farthestOf(uvec2 first) {
    uvec2 size = uvec2(frame.camera.width_px, frame.camera.height_px);
    uvec2 end = min(first + kFarFine, size);
    float depth = kNoPixel;
    for (uint y = first.y; y < end.y; ++y) {
        for (uint x = first.x; x < end.x; ++x) {
            depth = min(depth, uintBitsToFloat(uint(words[y * size.x + x] >> 32)));
        }
    }
    return depth;
}

void main() {
    uint lane = gl_LocalInvocationIndex;
    uvec2 fine_count = blocksOf(kFarFine);
    uvec2 coarse_count = blocksOf(kFarCoarse);
    for (uint i = gl_WorkGroupID.x; i < coarse_count.x * coarse_count.y; i += gl_NumWorkGroups.x) {
        uvec2 coarse = uvec2(i % coarse_count.x, i / coarse_count.x);
        uvec2 fine = coarse * kFineOfCoarse + uvec2(lane % kFineOfCoarse, lane / kFineOfCoarse);
        farthest[lane] = farthestOf(fine * kFarFine);
        if (all(lessThan(fine, fine_count))) {
            far_depths[fine.y * fine_count.x + fine.x] = farthest[lane];
        }
        barrier();
        for (uint step = kFineOfCoarse * kFineOfCoarse / 2u; step > 0u; step /= 2u) {
            if (lane < step) {
                farthest[lane] = min(farthest[lane], farthest[lane + step]);
            }
            barrier();
        }
        if (lane == 0u) {
            far_depths[coarseBlocksBegin() + i] = farthest[0];
        }
        barrier();
    }
}

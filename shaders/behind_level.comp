// A level of the picture behind surfaces, from the one before, of which each texel is the mean of
// four.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interface/constants.h"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;

layout(set = 0, binding = 0) uniform sampler2D finer;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D coarser;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = imageSize(coarser);
    if (all(lessThan(texel, size))) {
        vec2 uv = (vec2(texel) + 0.5) / vec2(size);
        imageStore(coarser, texel, textureLod(finer, uv, 0.0));
    }
}

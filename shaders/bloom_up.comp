// Back to twice the size by the same spline: 3/4 of the nearest, 1/4 of the next, on either axis.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/bloom.glsl"

void main() {
    if (!insideTarget()) {
        return;
    }
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    ivec2 near = at >> 1;
    ivec2 next = near + 2 * (at & 1) - 1;
    vec3 along_near = mix(sourceAt(ivec2(next.x, near.y)), sourceAt(near), 0.75);
    vec3 along_next = mix(sourceAt(next), sourceAt(ivec2(near.x, next.y)), 0.75);
    put(at, mix(along_next, along_near, 0.75), bloom.share);
}

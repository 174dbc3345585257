// The picture's bright part by itself, for kinds that read it many times.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/bloom.glsl"

void main() {
    if (insideTarget()) {
        ivec2 at = ivec2(gl_GlobalInvocationID.xy);
        put(at, sourceAt(at), 1.0);
    }
}

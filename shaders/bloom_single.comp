// A Gaussian as one kernel of (2 reach + 1)^2 taps.
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
    int reach = int(bloom.reach);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            float weight = exp2(bloom.falloff * float(x * x + y * y));
            sum += weight * sourceAt(at + ivec2(x, y));
            weights += weight;
        }
    }
    put(at, sum / weights, 1.0);
}

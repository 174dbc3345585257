// A Gaussian along rows or along columns.
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
    ivec2 along = ivec2(bloom.step_x_px, bloom.step_y_px);
    int reach = int(bloom.reach);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int k = -reach; k <= reach; ++k) {
        float weight = exp2(bloom.falloff * float(k * k));
        sum += weight * sourceAt(at + k * along);
        weights += weight;
    }
    put(at, sum / weights, 1.0);
}

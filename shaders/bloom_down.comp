// To half the size by the quadratic B-spline's four taps a side, of which each pixel gives as much,
// wherever it lies: a single bright one does not flicker as it moves.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/bloom.glsl"

void main() {
    if (!insideTarget()) {
        return;
    }
    const float kWeights[4] = float[](1.0 / 8.0, 3.0 / 8.0, 3.0 / 8.0, 1.0 / 8.0);
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    vec3 sum = vec3(0.0);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) {
            sum += kWeights[y] * kWeights[x] * sourceAt(2 * at - 1 + ivec2(x, y));
        }
    }
    put(at, sum, 1.0);
}

// One step of the a trous wavelet (Holschneider et al. 1989): a cubic B-spline's five taps, with
// holes.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/bloom.glsl"

void main() {
    if (!insideTarget()) {
        return;
    }
    const float kWeights[3] = float[](6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0);
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    ivec2 holes = ivec2(bloom.step_x_px, bloom.step_y_px);
    vec3 sum = vec3(0.0);
    for (int y = -2; y <= 2; ++y) {
        for (int x = -2; x <= 2; ++x) {
            sum += kWeights[abs(y)] * kWeights[abs(x)] * sourceAt(at + ivec2(x, y) * holes);
        }
    }
    put(at, mix(sourceAt(at), sum, bloom.share), 1.0);
}

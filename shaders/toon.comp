// toon_compute: the norm of the accumulated colour through a Hermite ramp, and in bands; black
// stays black.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/frame.glsl"
#include "lib/tonemap.glsl"
#include "lib/screen.glsl"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (!insideScreen(pixel)) {
        return;
    }
    vec4 before = imageLoad(radiance_image, ivec2(pixel));
    vec3 color = before.rgb;
    if (texelFetch(depth_image, ivec2(pixel), 0).x > 0.0) {
        color = min(color, vec3(1e18)); // whose squares are finite
        float norm = length(color);
        float shade = toonRamp(norm);
        if (hasLight(kLightBands)) {
            shade = toonBand(shade, 0.0);
        }
        color = norm > 0.0 ? color * (shade / norm) : vec3(0.0);
    }
    if (hasOutput(kOutputRadiance)) {
        imageStore(radiance_image, ivec2(pixel), vec4(color, before.a));
    }
    if (hasOutput(kOutputPixels)) {
        storePixel(pixel, vec4(color, before.a));
    }
}

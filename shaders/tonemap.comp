// Exposure, tone map and packing, where no other pass does it on the way; of several samples a
// pixel each by itself, so that a bright one does not make the whole pixel white.
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
    if (hasOutput(kOutputSamples)) {
        uvec2 size = uvec2(frame.camera.width_px, frame.camera.height_px) / 2u;
        if (any(greaterThanEqual(pixel, size))) {
            return;
        }
        vec3 sum = vec3(0.0);
        vec3 background = backgroundAt(pixel.y, size.y);
        for (uint i = 0; i < 4; ++i) {
            uvec2 at = 2u * pixel + uvec2(i & 1u, i >> 1);
            sum += displayColor(imageLoad(radiance_image, ivec2(at)), background);
        }
        pixels[pixel.y * size.x + pixel.x] = packDisplay(0.25 * sum);
    } else if (insideScreen(pixel)) {
        storePixel(pixel, imageLoad(radiance_image, ivec2(pixel)));
    }
}

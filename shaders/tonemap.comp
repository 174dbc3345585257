// Exposure, tone map and packing, where no other pass does it on the way.
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
    if (insideScreen(pixel)) {
        storePixel(pixel, imageLoad(radiance_image, ivec2(pixel)).rgb);
    }
}

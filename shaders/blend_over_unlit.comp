// What blended surfaces came to, over a solid picture of which some is unlit. That has colours of
// the display, and radiance has no share in them that an exposure would not change: so what is seen
// there is mixed as the display shows it.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/frame.glsl"
#include "lib/tonemap.glsl"
#include "lib/screen.glsl"
#define BLEND_SET 2
#include "lib/blend_sums.glsl"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (!insideScreen(pixel)) {
        return;
    }
    vec4 blended = blendedAt(ivec2(pixel));
    if (blended == vec4(0.0)) {
        return;
    }
    vec4 solid = imageLoad(radiance_image, ivec2(pixel)); // alpha: radianceAlpha()
    vec4 both = blended + (1.0 - blended.a) * solid;
    if (solid.a > 1.0 && blended.a > 0.0) {
        vec3 own = displayColor(vec4(blended.rgb / blended.a, 1.0), vec3(0.0));
        both = vec4(mix(displayColor(solid, vec3(0.0)), own, blended.a), kUnlitAlpha);
    }
    imageStore(radiance_image, ivec2(pixel), both);
}

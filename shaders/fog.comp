// What solid surfaces and empty pixels show, seen through the medium.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/frame.glsl"
#include "lib/tonemap.glsl"
#include "lib/screen.glsl"
#include "lib/fog.glsl"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (insideScreen(pixel)) {
        float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
        float distance = depth > 0.0 ? distanceFromDepth(depth) : kFogFarthest_m;
        vec4 radiance = imageLoad(radiance_image, ivec2(pixel));
        vec4 fog = fogBefore(pixel, distance);
        // Of the background and of what is unlit as much is seen as passes.
        float alpha = fma(radiance.a - 1.0, fog.a, 1.0);
        imageStore(radiance_image, ivec2(pixel),
                   vec4(fma(radiance.rgb, vec3(fog.a), fog.rgb), alpha));
    }
}

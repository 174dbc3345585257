// The G-buffer's words from the visibility pass: what gbuffer.frag writes, without a rasteriser.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_shader_image_load_formatted : require
#extension GL_GOOGLE_include_directive : require
#ifdef FROXEL_BINDLESS
#extension GL_EXT_nonuniform_qualifier : require
#endif
#define FROXEL_CAMERA_ALONE
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/screen.glsl"
#include "lib/pixel_order.glsl"
#include "lib/visibility_set.glsl"
#include "lib/material.glsl"
#include "lib/visibility_surface.glsl"
#include "lib/visibility_resolve.glsl"

layout(local_size_x = 64) in;
layout(set = 2, binding = 14) uniform writeonly uimage2D words_image;

void main() {
    uvec2 pixel = gl_WorkGroupID.xy * kScreenGroup + pixelInGroup(gl_LocalInvocationIndex);
    if (!insideScreen(pixel)) {
        return;
    }
    float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
    uint id = texelFetch(id_image, ivec2(pixel), 0).x;
    if (depth > 0.0 && mine(id)) {
        VisibleTriangle t = fetchTriangle(id);
        vec3 position = positionFromDistance(pixel, solidDistance(t, pixel, depth));
        bool front;
        VertexData v = fetchSurface(t, pixel, front);
        GbufferSample g = shadeMaterial(v, baseColor(v), position, front);
        imageStore(words_image, ivec2(pixel), packGbuffer(g));
    }
}

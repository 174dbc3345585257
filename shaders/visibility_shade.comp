// forward.frag's twin in compute, for solid surfaces: from the visibility pass to radiance.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#ifdef FROXEL_BINDLESS
#extension GL_EXT_nonuniform_qualifier : require
#endif
#ifdef FROXEL_SUBGROUPS
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#endif
#include "lib/frame.glsl"
#include "lib/surface_radiance.glsl"
#include "lib/tonemap.glsl"
#include "lib/screen.glsl"
#include "lib/pixel_order.glsl"
#include "lib/visibility_set.glsl"
#include "lib/material.glsl"
#include "lib/visibility_surface.glsl"
#include "lib/visibility_resolve.glsl"

layout(local_size_x = 64) in;

// Where this dispatch shades nothing.
GbufferSample emptySample() {
    GbufferSample g;
    g.normal_view = vec3(0.0, 0.0, 1.0);
    g.base_color = g.emissive = vec3(0.0);
    g.roughness = g.occlusion = 1.0;
    g.metallic = 0.0;
    g.unlit = false;
    g.dielectric = usualDielectric();
#ifdef FROXEL_LAYERED
    g.layers = noLayers(g.normal_view);
    visible_flags = 0u;
#endif
    return g;
}

void main() {
    uvec2 pixel = gl_WorkGroupID.xy * kScreenGroup + pixelInGroup(gl_LocalInvocationIndex);
    bool inside = insideScreen(pixel);
    float depth = inside ? texelFetch(depth_image, ivec2(pixel), 0).x : 0.0;
    bool covered = depth > 0.0;
    uint id = covered ? texelFetch(id_image, ivec2(pixel), 0).x : 0u;
    covered = covered && mine(id);
    float distance = distanceFromDepth(1.0);
    vec3 position = positionFromDistance(pixel, distance);
    GbufferSample g = emptySample();
    if (covered) {
        VisibleTriangle t = fetchTriangle(id);
        distance = solidDistance(t, pixel, depth);
        position = positionFromDistance(pixel, distance);
        bool front;
        VertexData v = fetchSurface(t, pixel, front);
        g = shadeMaterial(v, baseColor(v), position, front);
    }
    Surface s = makeSurface(position, g.normal_view, g.roughness);
#ifdef FROXEL_LAYERED
    addLayers(g.layers, s);
#endif
    LightSum sum = sumLights(s, pixel, distance, covered && !g.unlit);
    vec3 lit = surfaceRadiance(g, s, sum);
    if (g.unlit) {
        lit = g.base_color;
    }
    vec4 radiance = covered ? vec4(lit, radianceAlpha(g)) : vec4(0.0);
    if (inside && (covered || (depth == 0.0 && (resolve_flags & kResolveLast) != 0u))) {
        if (hasOutput(kOutputRadiance)) {
            imageStore(radiance_image, ivec2(pixel), radiance);
        }
        if (hasOutput(kOutputPixels)) {
            storePixel(pixel, radiance);
        }
    }
}

// Forward shading of opaque, masked and transparent surfaces (naive, forward_plus, and the
// transparent part of every renderer). Writes premultiplied linear radiance: where transparency is
// weighted, times a weight of distance; where it is peeled, of the layer's own triangle alone. A
// solid surface's alpha is radianceAlpha().
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
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
#include "lib/material.glsl"
#include "lib/fragment_inputs.glsl"
#include "lib/fog.glsl"
#include "lib/before_transmissive.glsl"

#ifdef FROXEL_TRANSMISSION
#define FROXEL_BEHIND_SET 2
#include "lib/transmission.glsl"
layout(location = 5) flat in mat3 object_from_view;
#endif

#ifdef FROXEL_PEELED
#include "lib/peel.glsl"
#endif

#ifdef FROXEL_WEIGHTED
layout(location = 0) out vec4 weighted_sum; // alpha: 1 - alpha is multiplied in
layout(location = 1) out float weight_sum;

// Of surfaces at a distance in metres (McGuire and Bavoil 2013, equation 7).
float distanceWeight(float distance) {
    float near = distance / 5.0;
    float far = distance / 200.0;
    float far2 = far * far;
    return clamp(10.0 / (1e-5 + near * near + far2 * far2 * far2), 1e-2, 3e3);
}

void store(vec3 color, float alpha, float distance) {
    float weight = alpha * distanceWeight(distance);
    weighted_sum = vec4(color * (alpha * weight), alpha);
    weight_sum = alpha * weight;
}
#else
layout(location = 0) out vec4 radiance;

void store(vec3 color, float alpha, float distance) { radiance = vec4(color * alpha, alpha); }
#endif

void main() {
    VertexData v = vertexData();
    vec4 base = baseColor(v);
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    float distance = distanceFromDepth(gl_FragCoord.z);
    vec3 position = positionFromDistance(pixel, distance);
    GbufferSample g = shadeMaterial(v, base, position, gl_FrontFacing);
    if (maskedOut(base) || !drawnNow(gl_FragCoord)) {
        discard;
    }
#ifdef FROXEL_PEELED
    if (texelFetch(layer_keys, ivec2(pixel), 0).g != peelOrder()) {
        discard; // another triangle at the same depth is this layer
    }
#endif
    float alpha = hasMaterial(kMaterialBlend) ? clamp(base.a, 0.0, 1.0) : 1.0;
    if (g.unlit) {
        bool blended = hasMaterial(kMaterialBlend);
        store(throughFog(blended ? shownAs(g.base_color) : g.base_color, pixel, distance), alpha,
              distance);
#ifndef FROXEL_WEIGHTED
        if (!blended) {
            radiance.a = radianceAlpha(g);
        }
#endif
        return;
    }
    Surface s = makeSurface(position, g.normal_view, g.roughness);
#ifdef FROXEL_LAYERED
    addLayers(g.layers, s);
#endif
    LightSum sum = sumLights(s, pixel, distance, true);
    vec3 behind = vec3(0.0);
#ifdef FROXEL_TRANSMISSION
    behind = broughtBehind(s, g.layers.transmission, pixel, gl_FragCoord.z, distance,
                           object_from_view, sum);
#endif
    vec3 lit = surfaceRadiance(g, s, sum, behind);
    store(throughFog(lit, pixel, distance), alpha, distance);
}

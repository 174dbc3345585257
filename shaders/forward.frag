// Forward shading of opaque, masked and transparent surfaces (naive, forward_plus, and the
// transparent part of every renderer). Writes premultiplied linear radiance.
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
#include "lib/gbuffer.glsl"
#include "lib/light_loop.glsl"
#include "lib/material.glsl"
#include "lib/fragment_inputs.glsl"

layout(location = 0) out vec4 radiance;

void main() {
    VertexData v = vertexData();
    vec4 base = baseColor(v);
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    float distance = distanceFromDepth(gl_FragCoord.z);
    vec3 position = positionFromDistance(pixel, distance);
    GbufferSample g = shadeMaterial(v, base, position, gl_FrontFacing);
    if (maskedOut(base)) {
        discard;
    }
    float alpha = hasMaterial(kMaterialBlend) ? clamp(base.a, 0.0, 1.0) : 1.0;
    if (g.unlit) {
        radiance = vec4(g.base_color * alpha, alpha);
        return;
    }
    Surface s = makeSurface(position, g.normal_view, g.roughness);
    LightSum sum = sumLights(s, pixel, distance, true);
    vec3 lit = shadeSum(sum, g.base_color, g.metallic) +
               ambientRadiance(s, g.base_color, g.metallic, g.occlusion) + g.emissive;
    radiance = vec4(lit * alpha, alpha);
}

// What a surface lets pass of a lamp's light, and where it is, beside a shadow map. A surface with
// a body has another side, where the light leaves: each takes the root of it.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#define FROXEL_CAMERA_ALONE
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/material.glsl"
#include "lib/fragment_inputs.glsl"

layout(location = 0) out vec4 passes; // alpha: as a shadow map's depth

void main() {
    VertexData v = vertexData();
    vec4 base = baseColor(v);
    if (maskedOut(base)) {
        discard;
    }
    float share = material.transmission.strength * (1.0 - metalness(v));
    if (hasTexture(transmission_slot)) {
        share *= sampleMaterial(transmission, v).r;
    }
    float alpha = hasMaterial(kMaterialBlend) ? clamp(base.a, 0.0, 1.0) : 1.0;
    vec3 color = clamp(base.rgb, vec3(0.0), vec3(1.0)) * share;
    if (material.volume.thickness_m > 0.0) {
        color *= leftOfBody(v);
        color = sqrt(color);
    }
    passes = vec4(mix(vec3(1.0), color, alpha), gl_FragCoord.z);
}

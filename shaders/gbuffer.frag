// Geometry pass of the deferred renderers.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#define FROXEL_CAMERA_ALONE
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/material.glsl"
#include "lib/fragment_inputs.glsl"

layout(location = 0) out uvec4 words;
#ifdef FROXEL_EXTRA
layout(location = 1) out uvec4 extra;
#endif

void main() {
    VertexData v = vertexData();
    vec4 base = baseColor(v);
    vec3 position = positionFromDistance(uvec2(gl_FragCoord.xy), distanceFromDepth(gl_FragCoord.z));
    GbufferSample g = shadeMaterial(v, base, position, gl_FrontFacing);
    if (maskedOut(base)) {
        discard;
    }
    words = packGbuffer(g);
#ifdef FROXEL_EXTRA
    extra = packExtra(g, position, gl_FragCoord.z);
#endif
}

// Which triangle a pixel shows; masked materials test their alpha.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#ifdef FROXEL_MASKED
#define FROXEL_CAMERA_ALONE
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/material.glsl"

layout(location = 1) in vec2 uv0;
#ifdef FROXEL_EXTENDED
layout(location = 2) in vec2 uv1;
layout(location = 3) in vec4 color;
#else
const vec2 uv1 = vec2(0.0);
const vec4 color = vec4(1.0);
#endif
#endif

layout(location = 5) flat in uint first_id;
layout(location = 0) out uint id;

void main() {
#ifdef FROXEL_MASKED
    if (maskedOut(baseColor(VertexData(vec3(0.0), uv0, uv1, color, vec4(0.0))))) {
        discard;
    }
#endif
    id = first_id | uint(gl_PrimitiveID);
}

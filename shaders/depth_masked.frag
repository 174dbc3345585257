// Alpha cut-out for the depth prepass, or for the count of fragments.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#define FROXEL_CAMERA_ALONE
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/material.glsl"
#include "lib/fragment_inputs.glsl"

#ifdef FROXEL_COUNT
layout(location = 0) out vec4 count;
#endif

void main() {
    if (maskedOut(baseColor(vertexData()))) {
        discard;
    }
#ifdef FROXEL_COUNT
    count = vec4(1.0);
#endif
}

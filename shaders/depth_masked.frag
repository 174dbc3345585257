// Alpha cut-out for the depth prepass.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/material.glsl"
#include "lib/fragment_inputs.glsl"

void main() {
    if (maskedOut(baseColor(vertexData()))) {
        discard;
    }
}

// Alpha cut-out for the depth prepass, or for what a debug view stores of each fragment.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#define FROXEL_CAMERA_ALONE
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/material.glsl"
#include "lib/fragment_inputs.glsl"

#if defined(FROXEL_COUNT) || defined(FROXEL_INSTANCE)
#include "lib/stored_fragment.glsl"
#endif

void main() {
    vec4 base = baseColor(vertexData());
    if (maskedOut(base)) {
        discard;
    }
#ifdef FROXEL_INSTANCE
    if (hasMaterial(kMaterialBlend) && base.a <= 0.0) {
        discard; // there is nothing to see of it
    }
#endif
#if defined(FROXEL_COUNT) || defined(FROXEL_INSTANCE)
    stored = fragmentValue();
#endif
}

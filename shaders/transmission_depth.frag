// Which transmissive surface each pixel's layer is: the depth test keeps the nearest fragment that
// no solid surface hides and, of layers behind the nearest one, that is farther than the layer
// before.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#define FROXEL_CAMERA_ALONE
#include "lib/frame.glsl"
#ifdef FROXEL_MASKED
#include "lib/gbuffer.glsl"
#include "lib/material.glsl"
#include "lib/fragment_inputs.glsl"

bool isHole() { return maskedOut(baseColor(vertexData())); }
#else
bool isHole() { return false; }
#endif

layout(set = 2, binding = 0) uniform texture2D solid_depth;
layout(set = 2, binding = 1) uniform texture2D depth_before; // 0: nothing is before, nor behind

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    bool hidden = isHole() || gl_FragCoord.z < texelFetch(solid_depth, at, 0).r;
    if (hasOutput(kOutputBehindTransmissive)) {
        hidden = hidden || gl_FragCoord.z >= texelFetch(depth_before, at, 0).r;
    }
    if (hidden) {
        discard;
    }
}

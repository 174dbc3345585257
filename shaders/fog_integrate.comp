// Adds up the slices of the volume front to back, each weighted by what it takes of light that the
// slices before it have left: exact for a slice of constant source, whatever its thickness
// (Hillaire 2015, "Physically based and unified volumetric rendering in Frostbite").
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/frame.glsl"
#include "lib/fog.glsl"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;
layout(set = 1, binding = 0, scalar) buffer VolumeBlock { vec4 volume[]; };

void main() {
    uvec2 node = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(node, uvec2(fog.node_count_x, fog.node_count_y)))) {
        return;
    }
    uvec2 pixel = nodePixel(node);
    vec3 eye = positionFromDistance(pixel, 0.0);
    vec3 front = eye;
    vec3 sum = vec3(0.0);
    for (uint k = 0; k < fog.slice_count; ++k) {
        vec3 back = positionFromDistance(pixel, fogPlane(k + 1u));
        float taken = exp(-opticalDepth(eye, front)) * lostOver(opticalDepth(front, back));
        uint texel = fogTexelOf(uvec3(node, k));
        sum = min(fma(volume[texel].rgb, vec3(taken), sum), vec3(1e30));
        volume[texel] = vec4(sum, 1.0);
        front = back;
    }
}

// Counts the light-pixel pairs of the solid surfaces in view: the lights that a pixel's list hands
// it (all lights without lists), and those of them that reach it. Only recorded on request.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "interface/pairs_io.h"
#include "lib/frame.glsl"
#include "lib/light_loop.glsl"
#include "lib/pair_count.glsl"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;

layout(set = 1, binding = 1) uniform texture2D depth_image;
layout(set = 2, binding = 0, scalar) buffer PairBlock { PairCounts counts; };

shared uint group_evaluated;
shared uint group_contributing;

void countPixel(uvec2 pixel, float depth) {
    float distance = distanceFromDepth(depth);
    ClusterList list = handedList(pixel, distance);
    atomicAdd(group_evaluated, list.count);
    atomicAdd(group_contributing, countReaching(list, positionFromDistance(pixel, distance)));
}

void main() {
    if (gl_LocalInvocationIndex == 0) {
        group_evaluated = 0;
        group_contributing = 0;
    }
    barrier();
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (all(lessThan(pixel, uvec2(frame.camera.width_px, frame.camera.height_px)))) {
        float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
        if (depth > 0.0) {
            countPixel(pixel, depth);
        }
    }
    barrier();
    if (gl_LocalInvocationIndex == 0) {
        // 64 bits by hand: an old value that wraps carries one.
        if (atomicAdd(counts.evaluated_low, group_evaluated) + group_evaluated < group_evaluated) {
            atomicAdd(counts.evaluated_high, 1u);
        }
        if (atomicAdd(counts.contributing_low, group_contributing) + group_contributing <
            group_contributing) {
            atomicAdd(counts.contributing_high, 1u);
        }
    }
}

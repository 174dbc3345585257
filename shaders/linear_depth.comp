// The distance of each pixel's solid surface along the view axis, in metres, for whoever composes
// pictures; infinity where there is none.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/frame.glsl"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;

layout(set = 1, binding = 1) uniform texture2D depth_image;
layout(set = 2, binding = 0, scalar) writeonly buffer DistanceBlock { float distances[]; };

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (all(lessThan(pixel, uvec2(frame.camera.width_px, frame.camera.height_px)))) {
        float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
        distances[pixel.y * frame.camera.width_px + pixel.x] =
            depth > 0.0 ? distanceFromDepth(depth) : uintBitsToFloat(0x7f800000u);
    }
}

// Lines over the picture; behind a solid surface they are faint.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/frame.glsl"

layout(set = 1, binding = 1) uniform texture2D depth_image;
layout(location = 0) in vec3 color;
layout(location = 0) out vec4 radiance;

void main() {
    float depth = texelFetch(depth_image, ivec2(gl_FragCoord.xy), 0).x;
    float alpha = gl_FragCoord.z >= depth ? 1.0 : 0.25;
    radiance = vec4(color / frame.exposure * alpha, alpha); // as bright at any exposure
}

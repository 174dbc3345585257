// Lines that the host made (io::WireVertex).
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/frame.glsl"
#include "lib/clip.glsl"

layout(location = 0) in vec3 position_view;
layout(location = 1) in vec4 color_in;
layout(location = 0) out vec3 color;

void main() {
    gl_Position = project(position_view);
    // The colours of the map are for display.
    vec3 c = color_in.rgb;
    color = mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThan(c, vec3(0.04045)));
}

// What blended surfaces came to, over the solid picture: premultiplied radiance and alpha.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#define BLEND_SET 0
#include "lib/blend_sums.glsl"

layout(location = 0) out vec4 radiance;

void main() { radiance = blendedAt(ivec2(gl_FragCoord.xy)); }

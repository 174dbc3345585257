// What blended surfaces came to, over the solid picture: premultiplied radiance and alpha.
#version 460
#extension GL_EXT_samplerless_texture_functions : require

layout(set = 0, binding = 0) uniform texture2D sums;
#ifdef FROXEL_WEIGHTED
layout(set = 0, binding = 1) uniform texture2D weights;
#endif

layout(location = 0) out vec4 radiance;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(sums, at, 0);
#ifdef FROXEL_WEIGHTED
    float weight = texelFetch(weights, at, 0).r;
    float covered = 1.0 - sum.a;
    radiance = weight > 0.0 ? vec4(sum.rgb * (covered / weight), covered) : vec4(0.0);
#else
    radiance = sum;
#endif
}

// What blended surfaces came to, in targets of their own (render/frame/blend_targets.h), which are
// bound as set BLEND_SET.
layout(set = BLEND_SET, binding = 0) uniform texture2D sums;
#ifdef FROXEL_WEIGHTED
layout(set = BLEND_SET, binding = 1) uniform texture2D weights;
#endif

// Premultiplied radiance and alpha.
vec4 blendedAt(ivec2 at) {
    vec4 sum = texelFetch(sums, at, 0);
#ifdef FROXEL_WEIGHTED
    float weight = texelFetch(weights, at, 0).r;
    float covered = 1.0 - sum.a;
    return weight > 0.0 ? vec4(sum.rgb * (covered / weight), covered) : vec4(0.0);
#else
    return sum;
#endif
}

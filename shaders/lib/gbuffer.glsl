// The G-buffer's words: x = octahedral normal, y = base colour (gamma 2) and roughness,
// and in the wide layout z = metalness, occlusion, unlit, w = emission (shared exponent).
#include "lib/octahedral.glsl"

struct GbufferSample {
    vec3 normal_view;
    vec3 base_color;
    float roughness;
    float metallic;
    float occlusion;
    bool unlit;
    vec3 emissive;
};

// RGB9E5 as in the Vulkan specification, "Shared Exponent to RGB"; values up to 65408.
uint packSharedExponent(vec3 color) {
    vec3 c = clamp(color, vec3(0.0), vec3(65408.0));
    float top = max(max(c.r, c.g), max(c.b, 1.52587890625e-5));
    int exponent = max(-16, int(floor(log2(top)))) + 16;
    float scale = exp2(float(exponent - 24));
    if (uint(top / scale + 0.5) == 512u) {
        scale *= 2.0;
        ++exponent;
    }
    uvec3 m = uvec3(c / scale + 0.5);
    return m.r | (m.g << 9) | (m.b << 18) | (uint(exponent) << 27);
}

vec3 unpackSharedExponent(uint word) {
    uvec3 m = uvec3(word, word >> 9, word >> 18) & 511u;
    return vec3(m) * exp2(float(word >> 27) - 24.0);
}

uvec4 packGbuffer(GbufferSample g) {
    uvec4 words;
    words.x = packOctahedral(g.normal_view);
    words.y = packUnorm4x8(vec4(sqrt(g.base_color), g.roughness));
    words.z = packUnorm4x8(vec4(g.metallic, g.occlusion, g.unlit ? 1.0 : 0.0, 0.0));
    words.w = packSharedExponent(g.emissive);
    return words;
}

GbufferSample unpackGbuffer(uvec4 words) {
    GbufferSample g;
    g.normal_view = unpackOctahedral(words.x);
    vec4 base = unpackUnorm4x8(words.y);
    g.base_color = base.rgb * base.rgb;
    g.roughness = base.a;
    g.metallic = 0.0;
    g.occlusion = 1.0;
    g.unlit = false;
    g.emissive = vec3(0.0);
    if (hasOutput(kOutputWideGbuffer)) {
        vec4 rest = unpackUnorm4x8(words.z);
        g.metallic = rest.x;
        g.occlusion = rest.y;
        g.unlit = rest.z > 0.5;
        g.emissive = unpackSharedExponent(words.w);
    }
    return g;
}

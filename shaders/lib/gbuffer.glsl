// The G-buffer's words: x = normal, y = base colour (gamma 2) and roughness, and in the wide layout
// z = metalness, occlusion, unlit, w = emission (shared exponent). Layouts that were asked for
// instead of the default keep more in a second target: the position, then the third half of xyz16;
// then, in a word of its own, what dielectrics reflect.
#include "interface/gbuffer_io.h"
#include "lib/dielectric.glsl"
#include "lib/octahedral.glsl"
#include "lib/layer_types.glsl"

const uint kNormalEncoding = (OUTPUT_FLAGS >> kOutputNormalShift) & 7u;
const uint kPositionSource = (OUTPUT_FLAGS >> kOutputPositionShift) & 3u;
const int kEmissionExponent = int((OUTPUT_FLAGS >> kOutputEmissionShift) & 127u);

// 2 to the power of exponent, exactly.
float powerOfTwo(int exponent) { return uintBitsToFloat(uint(127 + exponent) << 23); }

struct GbufferSample {
    vec3 normal_view;
    vec3 base_color;
    float roughness;
    float metallic;
    float occlusion;
    bool unlit;
    vec3 emissive;
    Dielectric dielectric;
#ifdef FROXEL_LAYERED
    Layers layers;
#endif
};

// Of radiance where that solid surface is; what it means is displayColor()'s.
float radianceAlpha(GbufferSample g) { return g.unlit ? kUnlitAlpha : 1.0; }

// RGB9E5 as in the Vulkan specification, "Shared Exponent to RGB"; values up to
// kMostStoredEmission.
uint packSharedExponent(vec3 color) {
    vec3 c = clamp(color, vec3(0.0), vec3(kMostStoredEmission));
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

uint packNormal(vec3 n) {
    switch (kNormalEncoding) {
    case kNormalOct12:
        return packSigned(octahedral(n), 12);
    case kNormalOct10:
        return packSigned(octahedral(n), 10);
    case kNormalOct8:
        return packSigned(octahedral(n), 8);
    case kNormalXyz16:
    case kNormalXy16:
        return packHalf2x16(n.xy);
    case kNormalSpheremap16:
        return packHalf2x16(spheremap(n));
    default:
        return packSnorm2x16(octahedral(n));
    }
}

// z: xyz16's third half.
vec3 unpackNormal(uint word, float z) {
    switch (kNormalEncoding) {
    case kNormalOct12:
        return octahedralNormal(unpackSigned(word, 12));
    case kNormalOct10:
        return octahedralNormal(unpackSigned(word, 10));
    case kNormalOct8:
        return octahedralNormal(unpackSigned(word, 8));
    case kNormalXyz16:
        return normalize(vec3(unpackHalf2x16(word), z));
    case kNormalXy16: {
        vec2 xy = unpackHalf2x16(word);
        return vec3(xy, sqrt(max(1.0 - dot(xy, xy), 0.0)));
    }
    case kNormalSpheremap16:
        return spheremapNormal(unpackHalf2x16(word));
    default:
        return octahedralNormal(unpackSnorm2x16(word));
    }
}

uvec4 packGbuffer(GbufferSample g) {
    uvec4 words;
    words.x = packNormal(g.normal_view);
    words.y = packUnorm4x8(vec4(sqrt(g.base_color), g.roughness));
    words.z = packUnorm4x8(vec4(g.metallic, g.occlusion, g.unlit ? 1.0 : 0.0, 0.0));
    words.w = packSharedExponent(g.emissive * powerOfTwo(-kEmissionExponent));
    return words;
}

// Which word of the second target has what dielectrics reflect: the first that is free
// (render/pipelines/gbuffer_layout.h).
uint specularWord() {
    uint z = kNormalEncoding == kNormalXyz16 ? 1u : 0u;
    switch (kPositionSource) {
    case kPositionStoredDepth:
        return 1u + z;
    case kPositionFp32:
        return 3u; // z has it: refused
    case kPositionFp16:
        return 2u;
    default:
        return z;
    }
}

// What a layout asks for there.
uvec4 packLayout(GbufferSample g, vec3 position_view, float depth) {
    uint z = kNormalEncoding == kNormalXyz16 ? packHalf2x16(vec2(g.normal_view.z, 0.0)) : 0u;
    switch (kPositionSource) {
    case kPositionStoredDepth:
        return uvec4(floatBitsToUint(depth), z, 0u, 0u);
    case kPositionFp32:
        return uvec4(floatBitsToUint(position_view), z);
    case kPositionFp16: {
        vec3 p = clamp(position_view, vec3(-65504.0), vec3(65504.0));
        return uvec4(packHalf2x16(p.xy), packHalf2x16(vec2(p.z, 0.0)) | (z << 16), 0u, 0u);
    }
    default:
        return uvec4(z, 0u, 0u, 0u);
    }
}

// The second target's words: 16, 32, 64 or 128 bits of them exist.
uvec4 packExtra(GbufferSample g, vec3 position_view, float depth) {
    uvec4 words = packLayout(g, position_view, depth);
    if (hasOutput(kOutputSpecular)) {
        words[specularWord()] = packUnorm4x8(vec4(sqrt(g.dielectric.f0), g.dielectric.f90));
    }
    return words;
}

bool readsExtra() {
    return kPositionSource != kPositionDepth || kNormalEncoding == kNormalXyz16 ||
           hasOutput(kOutputSpecular);
}

// xyz16's third half.
float extraNormalZ(uvec4 extra) {
    switch (kPositionSource) {
    case kPositionStoredDepth:
        return unpackHalf2x16(extra.y).x;
    case kPositionFp32:
        return unpackHalf2x16(extra.w).x;
    case kPositionFp16:
        return unpackHalf2x16(extra.y).y;
    default:
        return unpackHalf2x16(extra.x).x;
    }
}

// The position where it is stored; elsewhere the one given.
vec3 extraPosition(uvec4 extra, vec3 from_depth) {
    switch (kPositionSource) {
    case kPositionFp32:
        return uintBitsToFloat(extra.xyz);
    case kPositionFp16:
        return vec3(unpackHalf2x16(extra.x), unpackHalf2x16(extra.y).x);
    default:
        return from_depth;
    }
}

GbufferSample unpackGbuffer(uvec4 words, uvec4 extra) {
    GbufferSample g;
    g.normal_view = unpackNormal(words.x, extraNormalZ(extra));
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
        g.emissive = unpackSharedExponent(words.w) * powerOfTwo(kEmissionExponent);
    }
    g.dielectric = usualDielectric();
    if (hasOutput(kOutputSpecular)) {
        vec4 specular = unpackUnorm4x8(extra[specularWord()]);
        g.dielectric = Dielectric(false, specular.rgb * specular.rgb, specular.a);
    }
    return g;
}

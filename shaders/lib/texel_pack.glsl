// Trilinear filtering of a material's packed textures, written out: a software rasteriser pays for
// every texture it samples (coordinates, level of detail, gathers and, for sRGB, decoding), here
// once for all of them. Texels lie as render/texel_pack.h says; repeat wrapping, sides powers of 2.

layout(set = MATERIAL_SET, binding = 6) uniform utextureBuffer pack_texels;

struct PackSample {
    vec3 color; // linear
    vec4 rest;  // normal as stored; alpha or roughness
};

void addTexel(int index, float weight, inout PackSample sum) {
    uvec2 words = texelFetch(pack_texels, index).xy;
    precise vec3 color = vec3(ivec3(words.x & 2047u, (words.x >> 11) & 2047u, words.x >> 22));
    color *= color;
    precise vec3 color_sum = sum.color + color * weight;
    sum.color = color_sum;
    if (hasMaterial(kMaterialPackedPair)) {
        precise vec4 rest =
            vec4(ivec4(ivec3(words.y, words.y >> 8, words.y >> 16) & 255, words.y >> 24));
        precise vec4 rest_sum = sum.rest + rest * weight;
        sum.rest = rest_sum;
    }
}

// One mip level, weighed.
void addLevel(vec2 uv, uint level, float weight, inout PackSample sum) {
    uvec2 log2_size = material.pack_log2_size - level;
    ivec2 size = ivec2(1) << ivec2(log2_size);
    // Levels before this one: a geometric series, divided by 3 exactly by its inverse modulo 2^32.
    uint texels = 1u << (log2_size.x + log2_size.y);
    uint first = (material.pack_texel_count - texels) * 4u * 0xaaaaaaabu;
    precise vec2 p = uv * vec2(size) - 0.5;
    vec2 corner = floor(p);
    vec2 f = p - corner;
    ivec2 i = ivec2(corner);
    ivec2 mask = size - 1;
    int above = int(first) + ((i.y & mask.y) << log2_size.x);
    int below = int(first) + (((i.y + 1) & mask.y) << log2_size.x);
    ivec2 x = ivec2(i.x, i.x + 1) & mask.x;
    vec2 left_right = vec2(1.0 - f.x, f.x) * weight;
    vec4 weights = vec4(left_right * (1.0 - f.y), left_right * f.y);
    addTexel(above + x.x, weights.x, sum);
    addTexel(above + x.y, weights.y, sum);
    addTexel(below + x.x, weights.z, sum);
    addTexel(below + x.y, weights.w, sum);
}

// Level of detail by the longer of the pixel's two steps over the texels, as samplers have it.
PackSample samplePack(vec2 uv, vec2 duv_dx, vec2 duv_dy) {
    vec2 size = vec2(ivec2(1) << ivec2(material.pack_log2_size));
    precise vec2 dx = duv_dx * size;
    precise vec2 dy = duv_dy * size;
    precise float step2 = max(max(dot(dx, dx), dot(dy, dy)), 1e-30);
    float lod = clamp(0.5 * log2(step2), 0.0, float(material.pack_last_level));
    float level = floor(lod);
    float next = lod - level;
    PackSample s = PackSample(vec3(0.0), vec4(0.0));
    addLevel(uv, uint(int(level)), 1.0 - next, s);
    addLevel(uv, uint(min(int(level) + 1, int(material.pack_last_level))), next, s);
    s.color *= vec3(vec2(1.0 / (2047.0 * 2047.0)), 1.0 / (1023.0 * 1023.0));
    s.rest *= 1.0 / 255.0;
    return s;
}

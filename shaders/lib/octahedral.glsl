// Unit vectors in two numbers. Octahedral: Cigolle et al. 2014, "A Survey of Efficient
// Representations for Independent Unit Vectors". Spheremap: Lambert's azimuthal projection, which
// loses the vector towards -z.

vec2 signNotZero(vec2 v) { return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0); }

vec2 octahedral(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    if (n.z < 0.0) {
        p = (1.0 - abs(p.yx)) * signNotZero(p);
    }
    return p;
}

vec3 octahedralNormal(vec2 p) {
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0) {
        n.xy = (1.0 - abs(n.yx)) * signNotZero(n.xy);
    }
    return normalize(n);
}

// Two signed numbers of `bits` each, the first lowest.
uint packSigned(vec2 p, int bits) {
    float top = float((1 << (bits - 1)) - 1);
    ivec2 q = ivec2(floor(clamp(p, vec2(-1.0), vec2(1.0)) * top + 0.5));
    uvec2 u = uvec2(q) & ((1u << bits) - 1u);
    return u.x | (u.y << bits);
}

vec2 unpackSigned(uint word, int bits) {
    ivec2 q = ivec2(bitfieldExtract(int(word), 0, bits), bitfieldExtract(int(word), bits, bits));
    return max(vec2(q) / float((1 << (bits - 1)) - 1), vec2(-1.0));
}

vec2 spheremap(vec3 n) { return n.xy * inversesqrt(max(8.0 * n.z + 8.0, 1e-12)); }

vec3 spheremapNormal(vec2 p) {
    vec2 q = 4.0 * p;
    float f = min(dot(q, q), 4.0);
    return vec3(q * sqrt(1.0 - 0.25 * f), 1.0 - 0.5 * f);
}

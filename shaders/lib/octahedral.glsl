// Unit vectors in two numbers (Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors"); 16 bits each: at most 0.0036 degrees off.

vec2 signNotZero(vec2 v) { return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0); }

uint packOctahedral(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    if (n.z < 0.0) {
        p = (1.0 - abs(p.yx)) * signNotZero(p);
    }
    return packSnorm2x16(p);
}

vec3 unpackOctahedral(uint packed_normal) {
    vec2 p = unpackSnorm2x16(packed_normal);
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0) {
        n.xy = (1.0 - abs(n.yx)) * signNotZero(n.xy);
    }
    return normalize(n);
}

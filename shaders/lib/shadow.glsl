// How much of each light that has shadow maps arrives at a surface: found once a pixel, before the
// lights are looped over, so that a loop only picks four bits. A function of the surface alone:
// every loop and every renderer sees the same.

struct ShadowFace {
    ivec2 tile; // its first texel
    int axis;
    float forward; // 1 or -1
};

vec3 turned(vec3 v, int axis) { return axis == 0 ? v.yzx : axis == 1 ? v.zxy : v; }

// In the light's frame; of a spot the one face that there is.
ShadowFace faceTowards(vec3 v, float first_tile, float face_count, int size_px) {
    ShadowFace face = ShadowFace(ivec2(0), 2, 1.0);
    int tile = int(first_tile);
    if (face_count > 1.0) {
        vec3 a = abs(v);
        face.axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
        float along = face.axis == 0 ? v.x : face.axis == 1 ? v.y : v.z;
        face.forward = along < 0.0 ? -1.0 : 1.0;
        tile += 2 * face.axis + (along < 0.0 ? 1 : 0);
    }
    face.tile = size_px * ivec2(tile % int(kShadowColumns), tile / int(kShadowColumns));
    return face;
}

// 1 where nothing in the map is nearer to the light than `along`, metres along the face's axis.
float shadowTap(ivec2 texel, float along, float near_m) {
    precise float stored = texelFetch(shadow_atlas, texel, 0).x * along;
    return stored <= near_m ? 1.0 : 0.0;
}

// What passes surfaces that transmit light, before what is `along` metres away; depths have 11
// bits.
float transmittanceTap(ivec2 texel, float along, float near_m) {
    vec4 passes = texelFetch(transmittance_atlas, texel, 0);
    precise float stored = passes.a * along;
    return stored <= near_m * 1.002 ? 1.0 : dot(passes.rgb, vec3(0.2126, 0.7152, 0.0722));
}

// Four comparisons, weighted bilinearly: a penumbra one texel wide.
//
// Bias. A texel's depth is that of the surface at its centre, up to a texel away from the receiver
// across u and v; over that distance a plane of normal n rises towards the light by texel * (|n_u|
// + |n_v|) along n, whatever the angle. Moved along n by more than that, no point of a plane is in
// its own shadow, also where light grazes it. The slope's share is 1.5 instead of 1, and half a
// texel is added, for normals that a map turned by up to 25 degrees. A caster less than that far
// above the receiver casts no shadow on it; and within a texel of an inner corner, where a texel
// shows the other surface, light is dimmed.
uint shadowLevel(Surface s, uint index) {
    int texel = int(index * kShadowTexels);
    vec4 x = texelFetch(shadow_texels, texel);
    vec4 y = texelFetch(shadow_texels, texel + 1);
    vec4 z = texelFetch(shadow_texels, texel + 2);
    vec3 position = texelFetch(shadow_texels, texel + 3).xyz;
    vec4 map = texelFetch(shadow_texels, texel + 4);
    precise vec3 d = s.position_view - position;
    precise vec3 v = vec3(d.x * x.x + d.y * x.y + d.z * x.z, d.x * y.x + d.y * y.y + d.z * y.z,
                          d.x * z.x + d.y * z.y + d.z * z.z);
    vec3 n = s.normal_view;
    precise vec3 normal = vec3(n.x * x.x + n.y * x.y + n.z * x.z, n.x * y.x + n.y * y.y + n.z * y.z,
                               n.x * z.x + n.y * z.y + n.z * z.z);
    int size_px = int(z.w);
    ShadowFace face = faceTowards(v, x.w, y.w, size_px);
    vec3 seen = turned(v, face.axis);
    vec3 seen_normal = turned(normal, face.axis);
    precise float offset =
        map.y * max(face.forward * seen.z, 0.0) *
        (kShadowBias + kShadowSlopeBias * (abs(seen_normal.x) + abs(seen_normal.y)));
    precise vec3 moved = seen + seen_normal * offset;
    precise float along = max(face.forward * moved.z, 1e-20);
    // Behind a spot, where its cone lets nothing through, this is anywhere in the tile.
    precise vec2 at = (0.5 + 0.5 * map.x * moved.xy / along) * z.w;
    at = clamp(at, vec2(0.5), vec2(z.w - 0.5));
    precise vec2 from_first = at - 0.5;
    vec2 first = min(floor(from_first), vec2(z.w - 2.0));
    precise vec2 f = from_first - first;
    ivec2 t = face.tile + ivec2(first);
    float a = shadowTap(t, along, map.z);
    float b = shadowTap(t + ivec2(1, 0), along, map.z);
    float c = shadowTap(t + ivec2(0, 1), along, map.z);
    float e = shadowTap(t + ivec2(1, 1), along, map.z);
    if (hasLight(kLightTransmitted) && map.w > 0.0) {
        a *= transmittanceTap(t, along, map.z);
        b *= transmittanceTap(t + ivec2(1, 0), along, map.z);
        c *= transmittanceTap(t + ivec2(0, 1), along, map.z);
        e *= transmittanceTap(t + ivec2(1, 1), along, map.z);
    }
    precise float low = fma(f.x, b - a, a);
    precise float high = fma(f.x, e - c, c);
    precise float share = fma(f.y, high - low, low);
    precise float level = fma(share, float(kShadowLevels), 0.5);
    return uint(level);
}

// Of a light's radiance at a point in the air, which is in no surface's own shadow.
float shadowInAir(vec3 position_view, uint shadow) {
    Surface nowhere = makeSurface(position_view, vec3(0.0), 1.0);
    return float(shadowLevel(nowhere, shadow)) / float(kShadowLevels);
}

// Bit i: light i with maps can reach the surface, by the steps of addLight(). What faces away gets
// nothing anyway, but where a ramp may lift it.
uint shadowsInReach(Surface s, uint count) {
    uint bits = 0u;
    for (uint i = 0; i < count; ++i) {
        vec4 reach = texelFetch(shadow_texels, int(i * kShadowTexels) + 3);
        precise vec3 l = reach.xyz - s.position_view;
        precise float d2 = fma(l.z, l.z, fma(l.y, l.y, l.x * l.x));
        precise float facing =
            fma(s.normal_view.z, l.z, fma(s.normal_view.y, l.y, s.normal_view.x * l.x));
        bool faces = hasLight(kLightToon) || facing > 0.0 || layersFace(s, l);
        bits |= faces && d2 * reach.w < 1.0 ? 1u << i : 0u;
    }
    return bits;
}

// Four bits a light, eight lights a word.
uvec4 findShadows(Surface s, bool lit) {
    uvec4 levels = uvec4(0xffffffffu);
    uint count = uint(textureSize(shadow_texels)) / kShadowTexels;
    uint left = lit ? shadowsInReach(s, count) : 0u;
    do {
        uint index = left != 0u ? uint(findLSB(left)) : 0u;
        // Each is 15 until now: what is taken away is flipped.
        uint taken =
            left != 0u ? (kShadowLevels - shadowLevel(s, index)) << ((index & 7u) * 4u) : 0u;
        uint word = index >> 3;
        levels ^= uvec4(word == 0u ? taken : 0u, word == 1u ? taken : 0u, word == 2u ? taken : 0u,
                        word == 3u ? taken : 0u);
        left &= left - 1u;
    } while (left != 0u);
    return levels;
}

// Of a light's irradiance; exactly 1 without a map.
float shadowShare(Surface s, uint shadow) {
    uint word = shadow >> 3;
    uint levels = word < 2u ? (word == 0u ? s.shadows.x : s.shadows.y)
                            : (word == 2u ? s.shadows.z : s.shadows.w);
    uint level = (levels >> ((shadow & 7u) * 4u)) & kShadowLevels;
    bool whole = shadow == kNoShadow || level == kShadowLevels;
    precise float share = float(level) * (1.0 / float(kShadowLevels));
    return whole ? 1.0 : share;
}

#ifdef FROXEL_LAYERED
// Of the surface's other side, where light comes through it.
void findShadowsOfLayers(bool lit, inout Surface s) {
    if (litFromBehind()) {
        s.layers.shadows_behind = findShadows(behindOf(s), lit);
    }
}

// Of a light's irradiance on a layer: `share` as on the surface, whose shadows the layers over it
// have; of `whole` what arrives on its other side.
float shareOnLayer(Surface layer, uint shadow, float whole, float share) {
    if (isBehind(layer) && hasLight(kLightShadows)) {
        precise float seen = whole * shadowShare(layer, shadow);
        return seen;
    }
    return share;
}
#else
void findShadowsOfLayers(bool lit, inout Surface s) {}
#endif

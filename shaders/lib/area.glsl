// Rectangular lights: the same radiance from every point of one side, integrated over the rectangle
// in closed form. What it scatters is the irradiance of the part above the surface: half the sum
// over that polygon's edges of the angle that an edge takes, times its plane's unit normal (Lambert
// 1760; Baum, Rushmeier and Winget 1989). A highlight is the same sum over the polygon under the
// inverse of the lobe's fitted transform (server/area_light_table). Fresnel's term is the table's
// for highlights, and for scattered light that of the mean direction.
#include "interface/area_io.h"

struct AreaRect {
    vec3 half_right;
    vec3 half_up;
    float inv_area;
};

AreaRect fetchArea(uint area) {
    vec4 right = texelFetch(area_texels, int(2u * area));
    vec4 up = texelFetch(area_texels, int(2u * area + 1u));
    return AreaRect(right.xyz, up.xyz, right.w);
}

// atan(t) / t for t2 = t^2 in 0 to 1, off by less than 1e-7: Chebyshev's interpolation.
float atanOver(float t2) {
    precise float y = fma(t2, 0.0028340643, -0.0160050305);
    y = fma(t2, y, 0.0425876075);
    y = fma(t2, y, -0.0749544544);
    y = fma(t2, y, 0.106367541);
    y = fma(t2, y, -0.142025705);
    y = fma(t2, y, 0.199924836);
    y = fma(t2, y, -0.333330668);
    y = fma(t2, y, 0.999999984);
    return y;
}

// The angle between a and b over |c|, where c = cross(a, b). Not by an arc cosine, which loses
// small angles.
float angleOver(vec3 a, vec3 b, vec3 c) {
    precise float sine = sqrt(dot(c, c));
    precise float cosine = dot(a, b);
    precise float size = sqrt(dot(a, a)) * sqrt(dot(b, b));
    precise float below = max(size + abs(cosine), 1e-30);
    precise float t = min(sine / below, 1.0);
    precise float y = atanOver(t * t);
    precise float narrow = 2.0 * y / below;
    precise float wide = fma(-2.0 * t, y, kPi) / max(sine, 1e-30);
    return cosine < 0.0 ? wide : narrow;
}

struct Flux {
    vec3 whole;  // of all four edges
    float above; // along z, of the part with z > 0
};

// Seen from the origin: corner, corner + right, corner + right + up, corner + up. Positive on the
// side that cross(up, right) points to.
Flux fluxOf(vec3 corner, vec3 right, vec3 up) {
    precise vec3 far_corner = corner + right + up;
    vec3 at[4] = vec3[](corner, corner + right, far_corner, corner + up);
    vec3 along[4] = vec3[](right, up, -right, -up);
    precise vec3 whole = vec3(0.0);
    precise float above = 0.0;
    vec3 entry = vec3(0.0);
    vec3 leave = vec3(0.0);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        vec3 a = at[i];
        vec3 b = at[(i + 1) & 3];
        // Not cross(a, b), which cancels for an edge that is short from here.
        precise vec3 c = cross(a, along[i]);
        precise vec3 edge = c * angleOver(a, b, c);
        whole += edge;
        bool a_above = a.z > 0.0;
        bool b_above = b.z > 0.0;
        precise float up_part = a_above && b_above ? edge.z : 0.0;
        if (a_above != b_above) {
            precise float t = a.z / (a.z - b.z);
            precise vec3 crossing = vec3(fma(along[i].xy, vec2(t), a.xy), 0.0);
            precise vec3 part = c * (a_above ? t : 1.0 - t);
            up_part =
                part.z * (a_above ? angleOver(a, crossing, part) : angleOver(crossing, b, part));
            leave = a_above ? crossing : leave;
            entry = a_above ? entry : crossing;
        }
        above += up_part;
    }
    // The edge along the horizon; none: both are 0.
    precise vec3 c = vec3(0.0, 0.0, leave.x * entry.y - leave.y * entry.x);
    precise float horizon = c.z * angleOver(leave, entry, c);
    above += horizon;
    return Flux(whole, max(above, 0.0));
}

// The surface's axes in view space: z its normal, the eye on x's side.
mat3 axesOf(Surface s) {
    vec3 n = s.normal_view;
    precise vec3 x = s.to_eye_view - n * dot(n, s.to_eye_view);
    // Head-on any will do: the lobe is round.
    if (dot(x, x) < 1e-8) {
        x = abs(n.x) < 0.6 ? vec3(0.0, n.z, -n.y) : vec3(-n.z, 0.0, n.x);
    }
    x = x * inversesqrt(max(dot(x, x), 1e-30));
    return mat3(x, cross(n, x), n);
}

vec3 inAxes(mat3 axes, vec3 v) {
    precise vec3 local = vec3(dot(axes[0], v), dot(axes[1], v), dot(axes[2], v));
    return local;
}

struct Ltc {
    vec4 inverse; // (a, 0, b), (0, 1, 0), (c, 0, d)
    vec2 albedo;  // of the lobe, and of its grazing part
};

Ltc ltcEntry(uint entry) {
    int texel = int(entry * kLtcTexels);
    return Ltc(texelFetch(ltc_texels, texel), texelFetch(ltc_texels, texel + 1).xy);
}

Ltc ltcOf(Surface s) {
    const float kLast = float(kLtcSize - 1u);
    precise float roughness = sqrt(sqrt(s.alpha2));
    precise float row =
        clamp((roughness - kLtcLeastRoughness) / (1.0 - kLtcLeastRoughness), 0.0, 1.0) * kLast;
    precise float column = sqrt(clamp(1.0 - s.n_dot_v, 0.0, 1.0)) * kLast;
    uvec2 first = min(uvec2(column, row), uvec2(kLtcSize - 2u));
    precise vec2 f = vec2(column, row) - vec2(first);
    uint entry =
        first.y * kLtcSize + first.x + (hasLight(kLightBlinnPhong) ? kLtcSize * kLtcSize : 0u);
    Ltc a = ltcEntry(entry);
    Ltc b = ltcEntry(entry + 1u);
    Ltc c = ltcEntry(entry + kLtcSize);
    Ltc d = ltcEntry(entry + kLtcSize + 1u);
    precise vec4 inverse = mix(mix(a.inverse, b.inverse, f.x), mix(c.inverse, d.inverse, f.x), f.y);
    precise vec2 albedo = mix(mix(a.albedo, b.albedo, f.x), mix(c.albedo, d.albedo, f.x), f.y);
    return Ltc(inverse, albedo);
}

vec3 transformed(Ltc ltc, vec3 v) {
    precise vec3 plain = vec3(fma(ltc.inverse.x, v.x, ltc.inverse.y * v.z), v.y,
                              fma(ltc.inverse.z, v.x, ltc.inverse.w * v.z));
    return plain;
}

// What the rectangle takes of all directions from the origin, sr (Van Oosterom and Strackee 1983).
float solidAngle(vec3 to_light, AreaRect rect) {
    vec3 corner = to_light - rect.half_right - rect.half_up;
    vec3 far_corner = to_light + rect.half_right + rect.half_up;
    vec3 at[2] = vec3[](corner + 2.0 * rect.half_right, corner + 2.0 * rect.half_up);
    vec3 a = normalize(corner);
    vec3 c = normalize(far_corner);
    precise float sum = 0.0;
    [[unroll]] for (int i = 0; i < 2; ++i) {
        vec3 b = normalize(at[i]);
        precise float volume = abs(dot(a, cross(b, c)));
        precise float below = 1.0 + dot(a, b) + dot(b, c) + dot(c, a);
        sum += 2.0 * atan(volume, below);
    }
    return sum;
}

// Fibres have no transform to a cosine: the rectangle is 3 x 3 small lights (Gauss and Legendre's
// points), which together take as much of all directions. Of a rectangle that takes much of them
// that is coarse.
void addToFibres(Surface s, AreaRect rect, vec3 to_light, float scale, vec3 color,
                 inout LightSum sum) {
    const float kAt[3] = float[](-0.7745967, 0.0, 0.7745967);
    const float kWeight[3] = float[](5.0, 8.0, 5.0);
    LightSum parts = noLight();
    float taken = 0.0;
    for (int i = 0; i < 9; ++i) {
        precise vec3 to_part = to_light + kAt[i % 3] * rect.half_right + kAt[i / 3] * rect.half_up;
        float inv_d = inversesqrt(max(dot(to_part, to_part), kLeastDistance2));
        vec3 l = to_part * inv_d;
        float solid_angle = kWeight[i % 3] * kWeight[i / 3] * (inv_d * inv_d) * inv_d;
        taken += solid_angle;
        addIrradiance(s, l, dot(s.normal_view, l), dot(s.to_eye_view, l), solid_angle, 0.0,
                      vec3(1.0), parts);
    }
    precise float radiance = scale * solidAngle(to_light, rect) / taken;
    sum.specular += color * (parts.specular * radiance);
    sum.grazing += color * (parts.grazing * radiance);
}

// `share`: 0 or 1; of color, what the rectangle sends along its normal, candela.
void addAreaLight(Surface s, AreaRect rect, vec3 to_light, float inv_radius2, vec3 color,
                  float share, inout LightSum sum) {
    mat3 axes = axesOf(s);
    vec3 right = inAxes(axes, 2.0 * rect.half_right);
    vec3 up = inAxes(axes, 2.0 * rect.half_up);
    vec3 corner = inAxes(axes, to_light - rect.half_right - rect.half_up);
    Flux flux = fluxOf(corner, right, up);
    precise float scale =
        rangeWindow(dot(to_light, to_light) * inv_radius2) * rect.inv_area * share;
    precise float e = 0.5 * scale * flux.above;
    precise float size = sqrt(dot(flux.whole, flux.whole));
    precise float scattered = e;
    if (hasLight(kLightToon)) {
        precise float facing = max(flux.whole.z, 0.0) / max(size, 1e-30);
        scattered = 0.5 * scale * size * toonRamp(facing);
    }
    if (hasLight(kLightBands)) {
        scattered = toonBand(scattered, bandsMiddle(inv_radius2));
    }
    if (hasLight(kLightLambert)) {
        precise vec3 lambert = fma(color, vec3(scattered), sum.diffuse);
        sum.diffuse = lambert;
        return;
    }
    precise float v_dot_l = dot(flux.whole, inAxes(axes, s.to_eye_view)) / max(size, 1e-30);
    if (isFibres(s)) {
        addToFibres(s, rect, to_light, scale, color, sum);
        return;
    }
    precise float p = schlick(max(fma(2.0, v_dot_l, 2.0), 1e-6));
    Ltc ltc = ltcOf(s);
    Flux lobe = fluxOf(transformed(ltc, corner), transformed(ltc, right), transformed(ltc, up));
    if (hasLight(kLightBands)) {
        bool shines = e > 0.0 && lobe.above * ltc.albedo.x >= toonGloss(s.alpha2) * size;
        addBanded(scattered, shines, s.alpha2, color, sum);
        return;
    }
    // The transform may lift what is below the surface.
    precise float g = e > 0.0 ? scale * lobe.above : 0.0;
    precise float grazing = g * ltc.albedo.y;
    precise float specular = fma(g, ltc.albedo.x, -grazing);
    precise vec3 f = fma(color, vec3(specular), sum.specular);
    precise vec3 r = fma(color, vec3(grazing), sum.grazing);
    addScattered(scattered, p, color, sum);
    sum.specular = f;
    sum.grazing = r;
}

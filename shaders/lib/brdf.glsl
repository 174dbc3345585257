// Metallic-roughness shading as glTF 2.0 appendix B defines it: GGX distribution, height-correlated
// Smith visibility (Heitz 2014), Schlick's Fresnel term, Lambert scaled by 1 - F. A dielectric and
// a metal, each whole, are mixed by metalness. A light only adds weights that do not depend on the
// surface's colours; those are applied once, at the end.
// With kLightLambert only base colour / pi is left of it: no eye, no roughness, no metalness.
// With kLightBlinnPhong D V is Blinn's lobe instead, (n.h)^s (Blinn 1977) over its reflectance
// head-on, 8 pi (s + 2^(-s/2)) / ((s + 2)(s + 4)) (Giesen 2009, "Phong Normalization Factor
// derivations"), so that a white metal returns exactly all of what comes head-on. s = 2 / alpha^2 -
// 2, the exponent whose slopes vary as much as those of a Beckmann surface of that alpha (Walter et
// al. 2007, section 5.2).
#include "lib/dielectric.glsl"
#include "lib/layer_types.glsl"

const float kLeastDistance2 = 1e-30; // that the direction to a light is still taken from, m^2

struct Surface {
    vec3 position_view;
    vec3 normal_view;
    vec3 to_eye_view;   // unit
    float n_dot_v;      // its absolute value
    float n_dot_eye;    // negative where a normal map or interpolation turns the normal away
    float alpha2;       // roughness^4
    float visibility_v; // sqrt(n_dot_v^2 (1 - alpha2) + alpha2)
    float shininess;    // blinn_phong: half of s
    float lobe;         // blinn_phong: 2 pi times the lobe's height
    uvec4 shadows;      // what arrives of the lights with shadow maps (lib/shadow.glsl)
#ifdef FROXEL_LAYERED
    LayerSurfaces layers;
#endif
};

struct LightSum {
    vec3 diffuse;  // sum of E (1 - p), where p = (1 - l.h)^5; lambert: of E
    vec3 specular; // sum of E D V (1 - p)
    vec3 grazing;  // sum of E D V p
    vec3 edge;     // with kLightEdges: sum of E p
#ifdef FROXEL_LAYERED
    LayerSums layers;
#endif
};

LightSum noLight() {
    LightSum sum;
    sum.diffuse = sum.specular = sum.grazing = sum.edge = vec3(0.0);
#ifdef FROXEL_LAYERED
    sum.layers = noLayerLight();
#endif
    return sum;
}

Surface makeSurface(vec3 position_view, vec3 normal_view, float roughness) {
    precise Surface s;
    s.position_view = position_view;
    s.normal_view = normal_view;
    s.shadows = uvec4(0u); // found where lights are looped over
    if (hasLight(kLightLambert) && !hasLight(kLightRim)) {
        s.to_eye_view = vec3(0.0);
        s.n_dot_v = s.n_dot_eye = s.alpha2 = s.visibility_v = 0.0;
        s.shininess = s.lobe = 0.0;
        return s;
    }
    s.to_eye_view =
        frame.camera.orthographic != 0.0 ? vec3(0.0, 0.0, 1.0) : normalize(-position_view);
    s.n_dot_eye = dot(normal_view, s.to_eye_view);
    s.n_dot_v = max(abs(s.n_dot_eye), 1e-4);
    precise float alpha = max(roughness, 0.045) * max(roughness, 0.045);
    s.alpha2 = alpha * alpha;
    s.visibility_v = sqrt(s.n_dot_v * s.n_dot_v * (1.0 - s.alpha2) + s.alpha2);
    s.shininess = s.lobe = 0.0;
    if (hasLight(kLightBlinnPhong)) {
        precise float half_s = 1.0 / s.alpha2 - 1.0;
        s.shininess = half_s;
        precise float below = exp2(-half_s) + 2.0 * half_s;
        precise float lobe = (half_s + 1.0) * (half_s + 2.0) / below;
        s.lobe = lobe;
    }
    return s;
}

// (cosine^2)^power for cosine^2 = c2 / h2. Near 1 by a series in the sine: a software rasteriser's
// logarithm is off by 1e-5 there, and powers go up to 2e5.
float lobePower(float c2, float h2, float power) {
    precise float u = max(h2 - c2, 0.0) / (h2 + c2); // log(c2 / h2) = -2 atanh(u)
    precise float u2 = u * u;
    precise float series = u * fma(u2, fma(u2, fma(u2, 1.0 / 7.0, 1.0 / 5.0), 1.0 / 3.0), 1.0);
    precise float log2_cosine2 =
        u < 0.05 ? series * (-2.0 * 1.44269504) : log2(max(c2 / h2, 1e-30));
    precise float exponent = power * log2_cosine2;
    // Powers too small to matter end before they are denormal, which stages of llvmpipe flush or
    // keep.
    return exponent > -64.0 ? exp2(exponent) : 0.0;
}

#include "lib/layers.glsl"

// (1 - l.h)^5 for h2 = |l + v|^2.
float schlick(float h2) {
    precise float q = max(fma(-0.5, sqrt(h2), 1.0), 0.0);
    precise float p = (q * q) * (q * q) * q;
    return p;
}

// The falloff's ceiling: 1 / (1 cm)^2, in small scenes more.
float mostInverse2() { return hasLight(kLightSmallScene) ? frame.light_most_inverse2 : 1e4; }

// Of a light's irradiance at x = distance^2 / radius^2: exactly 0 at its radius.
float rangeWindow(float x) {
    precise float w = max(fma(-x, x, 1.0), 0.0);
    precise float window = w * w;
    return window;
}

// The middle of a light's toon bands, irradiance per candela.
float bandsMiddle(float inv_radius2) {
    return max(kToonMiddle * inv_radius2, frame.toon_least_middle);
}

// A toon surface's highlight, as a multiple of what a white surface scatters: half of its lobe's
// height, within what still can be seen as a spot. It is there where its lobe is at least as high.
float toonGloss(float alpha2) { return clamp(0.125 / alpha2, kToonLeastGloss, kToonMostGloss); }

// With kLightBands, of a light whose bands are at `banded`: no Fresnel's term, which has no steps.
void addBanded(float banded, bool shines, float alpha2, vec3 color, inout LightSum sum) {
    precise vec3 diffuse = fma(color, vec3(banded), sum.diffuse);
    precise float gloss = shines ? 2.0 * toonGloss(alpha2) * banded : 0.0;
    precise vec3 specular = fma(color, vec3(gloss), sum.specular);
    sum.diffuse = diffuse;
    sum.specular = specular;
}

// What is scattered of `scattered` where p of it meets an edge.
void addScattered(float scattered, float p, vec3 color, inout LightSum sum) {
    precise float diffuse = fma(-scattered, p, scattered);
    precise vec3 d = fma(color, vec3(diffuse), sum.diffuse);
    sum.diffuse = d;
    if (hasLight(kLightEdges)) {
        precise vec3 edge = fma(color, vec3(scattered * p), sum.edge);
        sum.edge = edge;
    }
}

// Adds light of irradiance colour * attenuation from direction l (unit); both dot products signed.
// middle: of its toon bands.
void addIrradiance(Surface s, vec3 l, float n_dot_l, float v_dot_l, float attenuation, float middle,
                   vec3 color, inout LightSum sum) {
    precise float facing = max(n_dot_l, 0.0);
    precise float e = attenuation * facing;
    // toon_fragment: the ramp is for what a surface scatters; a highlight stays where it is.
    precise float scattered = hasLight(kLightToon) ? attenuation * toonRamp(facing) : e;
    if (hasLight(kLightBands)) {
        scattered = toonBand(scattered, middle);
    }
    if (hasLight(kLightLambert)) {
        precise vec3 lambert = fma(color, vec3(scattered), sum.diffuse);
        sum.diffuse = lambert;
        return;
    }
    // The half vector only appears by |l + v|^2 and n.(l + v): no need to normalise it.
    precise float h2 = max(fma(2.0, v_dot_l, 2.0), 1e-6);
    precise float n_dot_sum = facing + s.n_dot_eye;
    precise float p = schlick(h2);
    precise float lobe;
    if (isFibres(s)) {
        lobe = fibresLobe(s, n_dot_sum, h2, facing);
    } else if (isStretched(s)) {
        lobe = stretchedLobe(s, l, n_dot_sum, h2, facing);
    } else if (hasLight(kLightBlinnPhong)) {
        precise float c2 = min(n_dot_sum * n_dot_sum, h2);
        lobe = s.lobe * lobePower(c2, h2, s.shininess);
    } else {
        precise float t = fma(min(n_dot_sum * n_dot_sum, h2), s.alpha2 - 1.0, h2);
        precise float visibility_l = sqrt(fma(facing * facing, 1.0 - s.alpha2, s.alpha2));
        precise float v = fma(facing, s.visibility_v, s.n_dot_v * visibility_l);
        lobe = s.alpha2 * (h2 * h2) / (t * t * v);
    }
    if (hasLight(kLightBands)) {
        bool shines = n_dot_sum > 0.0 && 0.5 * lobe * facing >= toonGloss(s.alpha2);
        addBanded(scattered, shines, s.alpha2, color, sum);
        return;
    }
    // No facet faces between light and eye where their half vector is behind the surface.
    precise float g = n_dot_sum > 0.0 ? e * lobe : 0.0;
    precise float grazing = g * p;
    precise float specular = g - grazing;
    precise vec3 f = fma(color, vec3(specular), sum.specular);
    precise vec3 r = fma(color, vec3(grazing), sum.grazing);
    addScattered(scattered, p, color, sum);
    sum.specular = f;
    sum.grazing = r;
}

// A point light; `share` is 0, 1 or a spot's angular falloff. Contributes exactly 0 at its radius.
void addLight(Surface s, vec3 to_light, float inv_radius2, vec3 color, float share,
              inout LightSum sum) {
    precise float d2 =
        fma(to_light.z, to_light.z, fma(to_light.y, to_light.y, to_light.x * to_light.x));
    precise float x = d2 * inv_radius2;
    precise float inv_d = inversesqrt(max(d2, kLeastDistance2));
    precise float attenuation = rangeWindow(x) * min(inv_d * inv_d, mostInverse2()) * share;
    precise float n_dot_l = fma(s.normal_view.z, to_light.z,
                                fma(s.normal_view.y, to_light.y, s.normal_view.x * to_light.x)) *
                            inv_d;
    precise float v_dot_l = fma(s.to_eye_view.z, to_light.z,
                                fma(s.to_eye_view.y, to_light.y, s.to_eye_view.x * to_light.x)) *
                            inv_d;
    addIrradiance(s, to_light * inv_d, n_dot_l, v_dot_l, attenuation, bandsMiddle(inv_radius2),
                  color, sum);
}

// Sums of lights as bright as floats go may be infinite, and black times that is no number: they
// end here.
const vec3 kMostSum = vec3(1e30);

// Outgoing radiance of all that was added.
vec3 shadeSum(LightSum sum, vec3 base_color, float metallic, Dielectric dielectric) {
    sum.diffuse = min(sum.diffuse, kMostSum);
    if (hasLight(kLightLambert)) {
        precise vec3 lambert = base_color * sum.diffuse / kPi;
        return lambert;
    }
    sum.specular = min(sum.specular, kMostSum);
    sum.grazing = min(sum.grazing, kMostSum);
    // Lobes are linear in f0; only the dielectric scatters, whatever its share.
    precise vec3 f0 = mix(dielectric.f0, base_color, metallic);
    precise vec3 albedo = base_color * (1.0 - metallic);
    precise vec3 lit;
    if (dielectric.usual) {
        precise vec3 lobe = 0.5 * (f0 * sum.specular + sum.grazing);
        lit = (albedo * (1.0 - kDielectricF0) * sum.diffuse + lobe) / kPi;
        return lit;
    }
    precise vec3 lobe =
        0.5 * (f0 * sum.specular + mix(dielectric.f90, 1.0, metallic) * sum.grazing);
    precise vec3 scattered = entering(dielectric) * sum.diffuse;
    if (hasLight(kLightEdges)) {
        scattered += (1.0 - dielectric.f90) * min(sum.edge, kMostSum);
    }
    lit = (albedo * scattered + lobe) / kPi;
    return lit;
}

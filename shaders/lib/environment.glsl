// What surfaces send of the light from around, as server/environment has it in double: matt ones
// see spherical harmonics, glossy ones the split sum. A surface's metal and dielectric part are
// each whole, as in lib/brdf.glsl.
#include "lib/environment_map.glsl"

layout(set = 0, binding = kLobesBinding) uniform textureBuffer lobe_texels; // kLobeTableSize

// What a lobe of reflectance 1 reflects in all, and of that the grazing part.
vec2 lobeAlbedo(float n_dot_v, float roughness) {
    const float kLast = float(kLobeTableSize - 1u);
    precise float column = kLast * pow(n_dot_v, 1.0 / 3.0);
    precise float row =
        kLast * sqrt(max(roughness - kLobeLeastRoughness, 0.0) / (1.0 - kLobeLeastRoughness));
    uvec2 first = min(uvec2(column, row), uvec2(kLobeTableSize - 2u));
    precise vec2 share = vec2(column, row) - vec2(first);
    int entry = int(first.y * kLobeTableSize + first.x);
    int below = entry + int(kLobeTableSize);
    precise vec2 albedo =
        mix(mix(texelFetch(lobe_texels, entry).xy, texelFetch(lobe_texels, entry + 1).xy, share.x),
            mix(texelFetch(lobe_texels, below).xy, texelFetch(lobe_texels, below + 1).xy, share.x),
            share.y);
    return albedo;
}

// With the light that leaves microfacets at a later bounce (environment::reflectedShare()).
vec3 reflectedShare(vec3 f0, float f90, vec2 albedo) {
    precise vec3 once = f0 * (albedo.x - albedo.y) + f90 * albedo.y;
    precise vec3 all = once * (1.0 + f0 * (1.0 / albedo.x - 1.0));
    return all;
}

// How much of its lobe an occluded surface sees (Lagarde and de Rousiers 2014, "Moving Frostbite to
// Physically Based Rendering", listing 26).
float glossyOcclusion(float n_dot_v, float occlusion, float roughness) {
    return clamp(pow(n_dot_v + occlusion, exp2(-16.0 * roughness - 1.0)) - 1.0 + occlusion, 0.0,
                 1.0);
}

float lobeAlpha(Surface s) { return min(sqrt(s.alpha2), 1.0); }
float lobeRoughness(Surface s) { return sqrt(lobeAlpha(s)); }

// The mean that the surface's lobe sees. A rough one is about a direction nearer to the normal
// (environment::lobeDirection()).
vec3 glossyAround(Surface s, float occlusion) {
    float alpha = lobeAlpha(s);
    vec3 mirrored = 2.0 * s.n_dot_eye * s.normal_view - s.to_eye_view;
    precise vec3 towards =
        mix(s.normal_view, mirrored, (1.0 - alpha) * (sqrt(1.0 - alpha) + alpha));
    return glossyRadiance(towards, alpha) * glossyOcclusion(s.n_dot_v, occlusion, lobeRoughness(s));
}

vec3 environmentRadiance(Surface s, vec3 base_color, float metallic, Dielectric dielectric,
                         float occlusion) {
    precise vec3 normal = environment.map_from_view * s.normal_view;
    precise vec3 matt = mattRadiance(normal) * occlusion;
    if (transmits()) {
        matt *= scatteredShare(s);
    }
    if (hasLight(kLightLambert)) {
        return base_color * matt;
    }
    vec2 albedo = lobeAlbedo(s.n_dot_v, lobeRoughness(s));
    vec3 of_dielectric = reflectedShare(dielectric.f0, dielectric.f90, albedo);
    vec3 of_metal = reflectedShare(base_color, 1.0, albedo);
    vec3 glossy = glossyAround(isStretched(s) ? bentByAnisotropy(s) : s, occlusion);
    float entering = 1.0 - max(max(of_dielectric.r, of_dielectric.g), of_dielectric.b);
    precise vec3 scattered = base_color * ((1.0 - metallic) * entering) * matt;
    if (scattersLightFromBehind()) {
        vec3 behind = mattRadiance(-normal) * (occlusion * scatteredShare(s));
        scattered =
            withLightFromBehind(s, base_color * matt, behind) * ((1.0 - metallic) * entering);
    }
    precise vec3 lit = mix(of_dielectric, of_metal, metallic) * glossy + scattered;
    return lit;
}

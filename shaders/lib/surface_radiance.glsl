// From what lights add up to on a surface to what the eye sees of it: what is around is added, and
// layers are put over it, the lowest first.
#include "lib/gbuffer.glsl"
#include "lib/light_loop.glsl"

#ifdef FROXEL_LAYERED
// What is around, as a matt surface sees it.
vec3 mattAround(Surface s, float occlusion) {
    if (hasLight(kLightEnvironment)) {
        return mattRadiance(environment.map_from_view * s.normal_view) * occlusion;
    }
    return skyRadiance(s.normal_view) * occlusion;
}

// What is around, as a matt surface of that base colour scatters it.
vec3 scatteredAround(Surface s, vec3 base_color, float occlusion) {
    vec3 scattered = base_color * mattAround(s, occlusion);
    if (scattersLightFromBehind()) {
        scattered = withLightFromBehind(s, scattered, mattAround(behindOf(s), occlusion));
    }
    return transmits() ? scattered * scatteredShare(s) : scattered;
}

// What lights behind the surface add up to there, as far as it lets them through; `own`, all
// lights' sum, then has as much less of what its own side scatters.
LightSum throughSurface(DiffuseTransmission through, Surface s, inout LightSum own) {
    LightSum behind = noLight();
    if (hasDiffuseTransmission()) {
        float left = 1.0 - through.strength;
        behind.diffuse = min(own.layers.behind, kMostSum) * through.strength;
        behind.edge = min(own.layers.behind_edge, kMostSum) * through.strength;
        own.diffuse = min(own.diffuse, kMostSum) * left;
        own.edge = min(own.edge, kMostSum) * left;
    }
    if (transmits()) {
        float scattered = scatteredShare(s);
        behind.diffuse *= scattered;
        behind.edge *= scattered;
        own.diffuse = min(own.diffuse, kMostSum) * scattered;
        own.edge = min(own.edge, kMostSum) * scattered;
    }
    return behind;
}

// What passes the surface: `behind`, and lights there by the same lobe as they would be mirrored
// by. enters, enters_around: the share of it that is not reflected; edges: and more at grazing
// angles.
vec3 transmitted(GbufferSample g, Surface s, LightSum sum, vec3 behind, float enters, float edges,
                 float enters_around) {
    precise vec3 lights = min(sum.layers.through, kMostSum) * enters +
                          min(sum.layers.through_grazing, kMostSum) * edges;
    precise vec3 passes = lights * (0.5 / kPi) + behind * enters_around;
    return passes * g.base_color * (s.layers.transmission * (1.0 - g.metallic));
}

// Of the eye's angle alone, where there is no environment whose lobes would be known.
float entersFromAround(Surface s, Dielectric dielectric) {
    vec3 reflected;
    if (hasLight(kLightEnvironment)) {
        reflected =
            reflectedShare(dielectric.f0, dielectric.f90, lobeAlbedo(s.n_dot_v, lobeRoughness(s)));
    } else {
        float left = 1.0 - s.n_dot_v;
        float p = (left * left) * (left * left) * left;
        reflected = mix(dielectric.f0, vec3(dielectric.f90), p);
    }
    return 1.0 - max(max(reflected.r, reflected.g), reflected.b);
}

vec3 transmittedBare(GbufferSample g, Surface s, LightSum sum, vec3 behind) {
    if (hasLight(kLightLambert)) {
        return behind * g.base_color * s.layers.transmission;
    }
    return transmitted(g, s, sum, behind, entering(g.dielectric), 1.0 - g.dielectric.f90,
                       entersFromAround(s, g.dielectric));
}

// `lit`, but what a film takes of the surface: what lights and what is around send from there, by
// one Fresnel term of the eye's for all. What is around is brought as in ambientRadiance().
vec3 underFilm(vec3 lit, Surface s, LightSum sum, LightSum behind, vec3 seen_behind,
               GbufferSample g) {
    if (!hasFilm()) {
        return lit;
    }
    Film film = g.layers.film;
    FilmWaves waves = filmWaves(film, s.n_dot_v);
    vec3 of_dielectric = filmReflects(waves, g.dielectric.f0, s.n_dot_v);
    vec3 of_metal = filmReflects(waves, g.base_color, s.n_dot_v);
    float entering = 1.0 - max(max(of_dielectric.r, of_dielectric.g), of_dielectric.b);
    float scatters = 1.0 - g.metallic;
    precise vec3 lobe = min(sum.specular, kMostSum) + min(sum.grazing, kMostSum);
    precise vec3 scattered = g.base_color * (min(sum.diffuse, kMostSum) + min(sum.edge, kMostSum));
    if (hasDiffuseTransmission()) {
        scattered += g.layers.diffuse_transmission.color *
                     (min(behind.diffuse, kMostSum) + min(behind.edge, kMostSum));
    }
    precise vec3 filmed = (scattered * (scatters * entering) +
                           mix(of_dielectric, of_metal, g.metallic) * lobe * 0.5) /
                          kPi;
    float enters_lights = entering;
    vec3 around = scatteredAround(s, g.base_color, g.occlusion) * scatters;
    if (hasLight(kLightEnvironment)) {
        float whole = lobeAlbedo(s.n_dot_v, lobeRoughness(s)).x;
        of_dielectric *= whole * (1.0 + of_dielectric * (1.0 / whole - 1.0));
        of_metal *= whole * (1.0 + of_metal * (1.0 / whole - 1.0));
        entering = 1.0 - max(max(of_dielectric.r, of_dielectric.g), of_dielectric.b);
        filmed += mix(of_dielectric, of_metal, g.metallic) *
                      glossyAround(isStretched(s) ? bentByAnisotropy(s) : s, g.occlusion) +
                  around * entering;
    } else {
        filmed += around * (entering / (1.0 - kDielectricF0)) +
                  mattAround(s, g.occlusion) * mix(of_dielectric, of_metal, g.metallic);
    }
    if (hasTransmission()) {
        // What facets reflect less at grazing angles passes, too: a film has one term for all.
        filmed += transmitted(g, s, sum, seen_behind, enters_lights, enters_lights, entering);
    }
    precise vec3 seen = mix(lit, filmed, film.strength);
    return seen;
}

// What the eye sees of a surface whose fibres are over `below`, which does not shine through them
// by itself. They reflect no more than what comes: at grazing angles their formula would.
vec3 underSheen(vec3 below, Surface s, LightSum sum, Sheen sheen, float occlusion) {
    if (!hasSheen()) {
        return below;
    }
    float whole = sheenAlbedo(s.n_dot_v, sheen.roughness);
    float albedo = min(whole, 1.0);
    precise vec3 scattered = mattAround(s, occlusion) * albedo;
    if (hasLight(kLightBands)) {
        scattered += min(sum.diffuse, kMostSum) * (albedo / kPi);
    } else {
        scattered += min(sum.layers.sheen, kMostSum) * (0.5 / kPi * albedo / whole);
    }
    vec3 color = sheen.color;
    float most = max(max(color.r, color.g), color.b);
    precise vec3 seen = below * (1.0 - most * albedo) + color * scattered;
    return seen;
}

// What the eye sees of a surface whose coat is over `below`; a coat reflects the ambient light as
// whole as what it covers does.
vec3 underCoat(vec3 below, Surface s, LightSum sum, Coat coat, float occlusion) {
    if (!hasCoat()) {
        return below;
    }
    Surface c = coatOf(s);
    vec3 around = hasLight(kLightEnvironment)
                      ? glossyAround(c, occlusion) * lobeAlbedo(c.n_dot_v, lobeRoughness(c)).x
                      : skyRadiance(c.normal_view) * occlusion;
    precise vec3 lobe = min(sum.layers.coat, kMostSum) * (0.5 / kPi) + around;
    float share = coatShare(coat, c.n_dot_v);
    precise vec3 seen = below * (1.0 - share) + lobe * share;
    return seen;
}
#endif

// What the eye sees of a lit surface, its layers and all. seen_behind: through it, where it
// transmits.
vec3 surfaceRadiance(GbufferSample g, Surface s, LightSum sum, vec3 seen_behind) {
    LightSum own = sum;
#ifdef FROXEL_LAYERED
    LightSum behind = throughSurface(g.layers.diffuse_transmission, s, own);
#endif
    precise vec3 lit = shadeSum(own, g.base_color, g.metallic, g.dielectric) +
                       ambientRadiance(s, g.base_color, g.metallic, g.dielectric, g.occlusion);
#ifdef FROXEL_LAYERED
    if (hasDiffuseTransmission()) {
        lit += shadeSum(behind, g.layers.diffuse_transmission.color, g.metallic, g.dielectric);
    }
    if (hasTransmission()) {
        lit += transmittedBare(g, s, sum, seen_behind);
    }
    lit = underFilm(lit, s, own, behind, seen_behind, g);
    lit = underSheen(lit, s, sum, g.layers.sheen, g.occlusion);
#endif
    precise vec3 seen = lit + g.emissive;
#ifdef FROXEL_LAYERED
    seen = underCoat(seen, s, sum, g.layers.coat, g.occlusion);
#endif
    return seen;
}

// Of one that nothing is seen through.
vec3 surfaceRadiance(GbufferSample g, Surface s, LightSum sum) {
    return surfaceRadiance(g, s, sum, vec3(0.0));
}

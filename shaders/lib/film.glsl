// A thin film over a surface (KHR_materials_iridescence): what Belcour and Barla 2017, "A Practical
// Extension to Microfacet Theory for the Modeling of Varying Iridescence", reflect by it, with
// Schlick's terms, as the extension has it. As a coat's, its Fresnel term is the eye's.
#ifndef FROXEL_FILM
#define FROXEL_FILM

struct Film {
    float strength;
    float ior;
    float thickness_nm;
};

bool hasFilm() { return hasMaterial(kMaterialFilm); }

Film noFilm() { return Film(0.0, 1.3, 400.0); }

// What the film's and the surface's dielectric and metal part reflect.
struct FilmShare {
    vec3 of_dielectric;
    vec3 of_metal;
};

// How a film's echo oscillates over the spectrum, as the eye's three sensitivities see it (a fit
// over frequencies), of its first and its second time to and fro.
struct FilmWaves {
    float ior;
    float cosine; // within the film
    vec3 once;
    vec3 twice;
};

vec3 filmWave(float path_nm) {
    const vec3 kHeight = vec3(5.4856e-13, 4.4201e-13, 5.2481e-13);
    const vec3 kPlace = vec3(1.6810e6, 1.7953e6, 2.2084e6);
    const vec3 kWidth = vec3(4.3278e9, 9.3046e9, 6.6121e9);
    const float kWhite = 1.0685e-7;
    precise float phase = 2.0 * kPi * 1e-9 * path_nm;
    precise vec3 xyz =
        kHeight * sqrt(2.0 * kPi * kWidth) * cos(kPlace * phase) * exp(-(phase * phase) * kWidth);
    precise float second = 9.7470e-14 * sqrt(2.0 * kPi * 4.5282e9) * cos(2.2399e6 * phase) *
                           exp(-4.5282e9 * (phase * phase));
    xyz.x += second;
    return xyz / kWhite;
}

FilmWaves filmWaves(Film film, float n_dot_v) {
    FilmWaves w;
    // The film fades in over its first 0.03 nm.
    precise float ior = mix(1.0, film.ior, smoothstep(0.0, 0.03, film.thickness_nm));
    precise float sine2 = (1.0 - n_dot_v * n_dot_v) / (ior * ior);
    precise float cosine = sqrt(max(1.0 - sine2, 0.0));
    precise float path_nm = 2.0 * ior * film.thickness_nm * cosine;
    w.ior = ior;
    w.cosine = cosine;
    w.once = filmWave(path_nm);
    w.twice = filmWave(2.0 * path_nm);
    return w;
}

float filmSchlick(float f0, float cosine) {
    float q = 1.0 - cosine;
    return mix((q * q) * (q * q) * q, 1.0, f0);
}

vec3 filmReflects(FilmWaves w, vec3 base_f0, float n_dot_v) {
    const mat3 kSrgbFromXyz = mat3(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108,
                                   -0.2040259, -0.4985314, 0.0415560, 1.0572252);
    precise float outer_root = (w.ior - 1.0) / (w.ior + 1.0);
    float outer = filmSchlick(outer_root * outer_root, n_dot_v);
    float through = 1.0 - outer;
    vec3 root = sqrt(clamp(base_f0, vec3(0.0), vec3(0.9999)));
    precise vec3 base_ior = (1.0 + root) / (1.0 - root);
    precise vec3 inner_root = (base_ior - w.ior) / (base_ior + w.ior);
    vec3 inner = vec3(filmSchlick(inner_root.r * inner_root.r, w.cosine),
                      filmSchlick(inner_root.g * inner_root.g, w.cosine),
                      filmSchlick(inner_root.b * inner_root.b, w.cosine));
    // Half a wave is lost at one of the borders or at both: the cosine's sign.
    vec3 side = mix(vec3(-1.0), vec3(1.0), lessThan(base_ior, vec3(w.ior)));
    vec3 both = min(outer * inner, vec3(0.9999));
    precise vec3 often = through * through * inner / (1.0 - both);
    precise vec3 wave = 2.0 * (often - through) * sqrt(both);
    precise vec3 sum = outer + often + wave * (kSrgbFromXyz * (w.once * side)) +
                       wave * sqrt(both) * (kSrgbFromXyz * w.twice);
    return clamp(sum, vec3(0.0), vec3(1.0));
}

#endif

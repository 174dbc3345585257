// Fibres that stand on a surface (KHR_materials_sheen): the distribution of Estevez and Kulla 2017,
// "Production Friendly Microfacet Sheen BRDF", and their own shadowing. What they reflect in all,
// what is below them lacks.
#ifndef FROXEL_SHEEN
#define FROXEL_SHEEN

struct Sheen {
    vec3 color;
    float roughness;
};

// What is lit of it.
struct SheenSurface {
    float power;      // of the squared sine: 1 / (2 alpha)
    float height;     // 2 + 1 / alpha
    float lambda_v;   // their shadowing towards the eye
    float[5] shading; // sheenCurve()
    float middle;     // twice the curve at 0.5
};

bool hasSheen() { return hasMaterial(kMaterialSheen); }

Sheen noSheen() { return Sheen(vec3(0.0), 1.0); }

// The curve whose exponential is lambda, fitted from fibres of alpha 0 to 1.
float sheenCurve(float[5] shading, float cosine) {
    precise float above = shading[0] / fma(shading[1], pow(cosine, shading[2]), 1.0);
    return above + fma(shading[3], cosine, shading[4]);
}

float sheenLambda(SheenSurface s, float cosine) {
    bool low = cosine < 0.5;
    float curve = sheenCurve(s.shading, max(low ? cosine : 1.0 - cosine, 1e-7));
    return exp(low ? curve : s.middle - curve);
}

SheenSurface sheenSurface(Sheen sheen, float n_dot_v) {
    precise SheenSurface s;
    float roughness = max(sheen.roughness, kLeastSheenRoughness);
    float alpha = roughness * roughness;
    s.power = 0.5 / alpha;
    s.height = 2.0 + 1.0 / alpha;
    float smoothness = (1.0 - alpha) * (1.0 - alpha);
    const float kRough[5] = float[](21.5473, 3.82987, 0.19823, -1.97760, -4.32054);
    const float kSmooth[5] = float[](25.3245, 3.32435, 0.16801, -1.27393, -4.85967);
    for (int i = 0; i < 5; ++i) {
        s.shading[i] = mix(kRough[i], kSmooth[i], smoothness);
    }
    s.middle = 2.0 * sheenCurve(s.shading, 0.5);
    s.lambda_v = sheenLambda(s, n_dot_v);
    return s;
}

// What white fibres reflect of even light, where it is below 1: within 0.0034 of the integral. A
// fit of our own.
float sheenAlbedo(float n_dot_v, float roughness) {
    precise float r = max(roughness, kLeastSheenRoughness);
    precise float root = sqrt(n_dot_v);
    precise float inv = 1.0 / r;
    // clang-format off
    precise float a = 0.0625263 * inv + fma(fma(fma(fma(1.73032, r, -15.4884), r, 26.41), r, -14.5488), r, 1.24355);
    precise float b = 0.00805877 * inv + fma(fma(fma(fma(10.4349, r, 5.24171), r, -36.5593), r, 22.0431), r, 2.61802);
    precise float c = -0.0977681 * inv + fma(fma(fma(fma(-16.3079, r, -7.16069), r, 51.7504), r, -27.3973), r, -7.91124);
    precise float d = -1.39239 * inv + fma(fma(fma(fma(8.38864, r, 13.1731), r, -40.7654), r, 15.1741), r, 7.99742);
    precise float e = -1.62432 * inv + fma(fma(fma(fma(2.00576, r, -16.4633), r, 23.9243), r, -9.26357), r, 0.135402);
    // clang-format on
    precise float log2_albedo =
        fma(fma(e, n_dot_v, d), n_dot_v, fma(fma(b, sqrt(root), c * root), 1.0, a));
    return exp2(log2_albedo);
}

#endif

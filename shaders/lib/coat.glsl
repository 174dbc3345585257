// A clear coat over a surface (KHR_materials_clearcoat). By the extension's own layering its
// Fresnel term is that of the eye alone: of the share that it gives, the eye sees the coat's lobe,
// of the rest what is below, emission and all.
#ifndef FROXEL_COAT
#define FROXEL_COAT

struct Coat {
    float strength;
    float roughness;
    vec3 normal_view;
};

// What is lit of it.
struct CoatSurface {
    vec3 normal_view;
    float n_dot_v;
    float n_dot_eye;
    float alpha2;
    float visibility_v;
    float shininess;
    float lobe;
};

bool hasCoat() { return hasMaterial(kMaterialCoat); }

Coat noCoat(vec3 normal_view) { return Coat(0.0, 0.0, normal_view); }

// Schlick's, of an index of refraction of 1.5.
float coatShare(Coat coat, float n_dot_v) {
    precise float q = max(1.0 - n_dot_v, 0.0);
    precise float p = (q * q) * (q * q) * q;
    precise float share = coat.strength * fma(1.0 - kDielectricF0, p, kDielectricF0);
    return share;
}

#endif

// What a surface's dielectric part reflects: KHR_materials_ior and KHR_materials_specular.
#ifndef FROXEL_DIELECTRIC
#define FROXEL_DIELECTRIC

struct Dielectric {
    bool usual; // usualDielectric(), where the variant knows of no other
    vec3 f0;    // head-on
    float f90;  // at grazing angles: the extension's strength
};

Dielectric usualDielectric() { return Dielectric(true, vec3(kDielectricF0), 1.0); }

// The share of light that may enter head-on. Of f0 (1 - p) + f90 p the largest channel is f0's for
// every p.
float entering(Dielectric d) { return 1.0 - max(max(d.f0.r, d.f0.g), d.f0.b); }

#endif

// What layers over a surface have of their own: in a material, in what is lit, in what lights add
// up to. A member a layer; all else asks lib/layers.glsl.
#ifndef FROXEL_LAYER_TYPES
#define FROXEL_LAYER_TYPES
#ifdef FROXEL_LAYERED
#include "lib/anisotropy.glsl"
#include "lib/coat.glsl"
#include "lib/diffuse_transmission.glsl"
#include "lib/film.glsl"
#include "lib/sheen.glsl"

// Light that passes the surface as through glass (lib/transmission.glsl).
struct Transmission {
    float strength;
    float roughness; // of what is seen through it
    float ior;
    float dispersion;
    float thickness; // of the body, in object space; 0: a thin wall
    vec3 attenuation_color;
    float attenuation_m; // 0: the body dims nothing
};

// The shaders of FROXEL_TRANSMISSION alone draw such surfaces.
#ifdef FROXEL_TRANSMISSION
bool hasTransmission() { return hasMaterial(kMaterialTransmission); }
bool hasBody() { return hasMaterial(kMaterialBody); }
bool hasDispersion() { return hasMaterial(kMaterialDispersion); }
bool isFrosted() { return hasMaterial(kMaterialFrosted); }
#else
bool hasTransmission() { return false; }
#endif

// Of what is seen through a surface of that roughness: as much less as the index of refraction is
// below 1.5, so that what bends nothing blurs nothing.
float transmittedRoughness(float roughness, float ior) {
    return roughness * clamp(ior * 2.0 - 2.0, 0.0, 1.0);
}

Transmission noTransmission() { return Transmission(0.0, 0.0, 1.0, 0.0, 0.0, vec3(1.0), 0.0); }

struct Layers {
    Coat coat;
    Sheen sheen;
    Anisotropy anisotropy;
    Film film;
    DiffuseTransmission diffuse_transmission;
    Transmission transmission;
};

// A lobe of facets: members of Surface.
struct LobeShape {
    float alpha2;
    float visibility_v;
    float shininess;
    float lobe;
};

struct LayerSurfaces {
    bool fibres; // lights meet the sheen's, not facets
    bool round;  // highlights are round, whatever the material's
    bool behind; // lights meet the surface's other side
    CoatSurface coat;
    SheenSurface sheen;
    AnisotropySurface anisotropy;
    DiffuseTransmission diffuse_transmission;
    float transmission;   // its strength
    LobeShape through;    // of what is seen through it
    uvec4 shadows_behind; // as Surface::shadows, of its other side
};

struct LayerSums {
    vec3 coat; // sums of E D V, all of the layer's own
    vec3 sheen;
    vec3 behind; // as LightSum's, of the other side
    vec3 behind_edge;
    vec3 through; // of the other side's lights, seen through the surface
    vec3 through_grazing;
};

Layers noLayers(vec3 normal_view) {
    return Layers(noCoat(normal_view), noSheen(), noAnisotropy(), noFilm(), noDiffuseTransmission(),
                  noTransmission());
}
LayerSums noLayerLight() {
    return LayerSums(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
}
#endif
#endif

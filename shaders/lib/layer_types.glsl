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

struct Layers {
    Coat coat;
    Sheen sheen;
    Anisotropy anisotropy;
    Film film;
    DiffuseTransmission diffuse_transmission;
};

struct LayerSurfaces {
    bool fibres; // lights meet the sheen's, not facets
    bool round;  // highlights are round, whatever the material's
    bool behind; // lights meet the surface's other side
    CoatSurface coat;
    SheenSurface sheen;
    AnisotropySurface anisotropy;
    DiffuseTransmission diffuse_transmission;
    uvec4 shadows_behind; // as Surface::shadows, of its other side
};

struct LayerSums {
    vec3 coat; // sums of E D V, all of the layer's own
    vec3 sheen;
    vec3 behind; // as LightSum's, of the other side
    vec3 behind_edge;
};

Layers noLayers(vec3 normal_view) {
    return Layers(noCoat(normal_view), noSheen(), noAnisotropy(), noFilm(),
                  noDiffuseTransmission());
}
LayerSums noLayerLight() { return LayerSums(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0)); }
#endif
#endif

// What layers over a surface have of their own: in a material, in what is lit, in what lights add
// up to. A member a layer; all else asks lib/layers.glsl.
#ifndef FROXEL_LAYER_TYPES
#define FROXEL_LAYER_TYPES
#ifdef FROXEL_LAYERED
#include "lib/anisotropy.glsl"
#include "lib/coat.glsl"
#include "lib/film.glsl"
#include "lib/sheen.glsl"

struct Layers {
    Coat coat;
    Sheen sheen;
    Anisotropy anisotropy;
    Film film;
};

struct LayerSurfaces {
    bool fibres; // lights meet the sheen's, not facets
    bool round;  // highlights are round, whatever the material's
    CoatSurface coat;
    SheenSurface sheen;
    AnisotropySurface anisotropy;
};

struct LayerSums {
    vec3 coat; // sums of E D V, all of the layer's own
    vec3 sheen;
};

Layers noLayers(vec3 normal_view) {
    return Layers(noCoat(normal_view), noSheen(), noAnisotropy(), noFilm());
}
LayerSums noLayerLight() { return LayerSums(vec3(0.0), vec3(0.0)); }
#endif
#endif

// What layers over a surface have of their own: in a material, in what is lit, in what lights add up
// to. A member a layer; all else asks lib/layers.glsl.
#ifndef FROXEL_LAYER_TYPES
#define FROXEL_LAYER_TYPES
#ifdef FROXEL_LAYERED
#include "lib/coat.glsl"

struct Layers {
    Coat coat;
};

struct LayerSurfaces {
    CoatSurface coat;
};

struct LayerSums {
    vec3 coat; // sum of E D V, all of the coat's own
};

Layers noLayers(vec3 normal_view) { return Layers(noCoat(normal_view)); }
LayerSums noLayerLight() { return LayerSums(vec3(0.0)); }
#endif
#endif

// What materials have beyond glTF's core but textures: a struct and a row each, as scenes hold them
// and as shaders read them. Members, checks and what is uploaded are made of the rows.
#ifndef FROXEL_INTERFACE_MATERIAL_FACTORS_H
#define FROXEL_INTERFACE_MATERIAL_FACTORS_H

#include "compat.h"

#define FROXEL_MATERIAL_FACTORS(X)                                                                 \
    X(CoatFactors, coat)                                                                           \
    X(SheenFactors, sheen)                                                                         \
    X(AnisotropyFactors, anisotropy)                                                               \
    X(FilmFactors, film)                                                                           \
    X(DiffuseTransmissionFactors, diffuse_transmission)                                            \
    X(VolumeFactors, volume)                                                                       \
    X(TransmissionFactors, transmission)

FROXEL_IO_NAMESPACE_BEGIN

// A clear coat over all of a material; its normal is the shape's where it has no map of its own.
struct CoatFactors {
    float strength FROXEL_USUAL(0); // 0..1; 0: none
    float roughness FROXEL_USUAL(0);
    float normal_scale FROXEL_USUAL(1);
    float padding0 FROXEL_USUAL(0);
};
FROXEL_SIZE_ASSERT(CoatFactors, 16);

// Fibres that stand on all of a material, below its coat.
struct SheenFactors {
    vec3 color FROXEL_USUAL(0); // 0..1; 0: none
    float roughness FROXEL_USUAL(0);
};
FROXEL_SIZE_ASSERT(SheenFactors, 16);

// Highlights that are longer in one direction of the surface.
struct AnisotropyFactors {
    float strength FROXEL_USUAL(0);     // 0..1; 0: none
    float rotation_rad FROXEL_USUAL(0); // of that direction, from the tangent towards the bitangent
    float padding0 FROXEL_USUAL(0);
    float padding1 FROXEL_USUAL(0);
};
FROXEL_SIZE_ASSERT(AnisotropyFactors, 16);

// A film as thin as light's waves, whose colours change with the angle.
struct FilmFactors {
    float strength FROXEL_USUAL(0); // 0..1; 0: none
    float ior FROXEL_USUAL(1.3F);
    float least_nm FROXEL_USUAL(100); // its thickness where the texture has 0
    float most_nm FROXEL_USUAL(400);  // where it has 1, or where there is none
};
FROXEL_SIZE_ASSERT(FilmFactors, 16);

// Light from behind that a surface scatters towards the eye, in place of as much of its base
// colour.
struct DiffuseTransmissionFactors {
    vec3 color FROXEL_USUAL(1);
    float strength FROXEL_USUAL(0); // 0..1; 0: none
};
FROXEL_SIZE_ASSERT(DiffuseTransmissionFactors, 16);

// The body behind a surface, which bends and dims what comes through it.
struct VolumeFactors {
    vec3 attenuation_color FROXEL_USUAL(1); // 0..1, of white light after
    float attenuation_m FROXEL_USUAL(0);    // this way; 0: nothing is dimmed
    float thickness_m FROXEL_USUAL(0);      // 0: no body; it is thin
    float padding0 FROXEL_USUAL(0);
    float padding1 FROXEL_USUAL(0);
    float padding2 FROXEL_USUAL(0);
};
FROXEL_SIZE_ASSERT(VolumeFactors, 32);

// Light from behind that passes a surface as through glass, in place of as much of what its base
// colour scatters.
struct TransmissionFactors {
    float strength FROXEL_USUAL(0);   // 0..1; 0: none
    float dispersion FROXEL_USUAL(0); // 20 over Abbe's number; 0: all colours are bent alike
    float padding0 FROXEL_USUAL(0);
    float padding1 FROXEL_USUAL(0);
};
FROXEL_SIZE_ASSERT(TransmissionFactors, 16);

FROXEL_IO_NAMESPACE_END

#endif

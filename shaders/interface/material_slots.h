// The textures of a material: X(number, name, colour), a row each. Whatever goes over textures is
// made of these rows, in C++ and in GLSL: members of materials, what a material has, transforms,
// bindings, samplers, checks and the reference's.
#ifndef FROXEL_INTERFACE_MATERIAL_SLOTS_H
#define FROXEL_INTERFACE_MATERIAL_SLOTS_H

#include "compat.h"

// colour: 1 where red, green and blue are sRGB; else all is linear. Numbers ascend by 1 from 0.
#define FROXEL_SURFACE_SLOTS(X)                                                                    \
    X(0, base_color, 1) /* with alpha */                                                           \
    X(1, normal, 0)                                                                                \
    X(2, metallic_roughness, 0) /* G: roughness, B: metalness */                                   \
    X(3, occlusion, 0)          /* R */                                                            \
    X(4, emissive, 1)                                                                              \
    X(5, specular, 0)       /* A: strength of the dielectric's reflection */                       \
    X(6, specular_color, 1) /* its colour; A: how glossy, where the material says so */
// Of layers over the surface: the shaders of FROXEL_LAYERED alone know them.
#define FROXEL_LAYER_SLOTS(X)                                                                      \
    X(7, coat, 0)           /* R: strength */                                                      \
    X(8, coat_roughness, 0) /* G */                                                                \
    X(9, coat_normal, 0)                                                                           \
    X(10, sheen_color, 1)                                                                          \
    X(11, sheen_roughness, 0)      /* A */                                                         \
    X(12, anisotropy, 0)           /* RG: direction, B: strength */                                \
    X(13, film, 0)                 /* R: strength */                                               \
    X(14, film_thickness, 0)       /* G */                                                         \
    X(15, diffuse_transmission, 0) /* A: strength */                                               \
    X(16, diffuse_transmission_color, 1)                                                           \
    X(17, thickness, 0)    /* G */                                                                 \
    X(18, transmission, 0) /* R: strength */
#define FROXEL_MATERIAL_SLOTS(X)                                                                   \
    FROXEL_SURFACE_SLOTS(X)                                                                        \
    FROXEL_LAYER_SLOTS(X)

FROXEL_IO_NAMESPACE_BEGIN

#define FROXEL_SLOT(number, name, colour) FROXEL_CONST uint name##_slot = number;
FROXEL_MATERIAL_SLOTS(FROXEL_SLOT)
#undef FROXEL_SLOT

FROXEL_CONST uint kSurfaceSlots = 7U;
FROXEL_CONST uint kMaterialSlots = 19U;

FROXEL_IO_NAMESPACE_END

#endif

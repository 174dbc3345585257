// Lights and light lists as the shaders read them: rows of 16-byte texels, or scalar block layout.
#ifndef FROXEL_INTERFACE_LIGHT_IO_H
#define FROXEL_INTERFACE_LIGHT_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

FROXEL_CONST uint kNoSpot = 0xffffffffU;

// A point or spot light. Its falloff window reaches exactly 0 where distance^2 * inv_radius2 >= 1.
struct Light {
    vec3 position_view;
    float inv_radius2; // 1/m^2; 0: no range limit
    vec3 color;        // linear, times intensity
    uint spot;         // index into the spot table, kNoSpot for a point light
};
FROXEL_SIZE_ASSERT(Light, 32);

// Angular falloff: clamp(dot(direction, -to_light) * scale + offset, 0, 1)^2.
struct Spot {
    vec3 direction_view; // unit, the way the light travels
    float scale;         // 1 / max(1e-3, cos(inner) - cos(outer)), made in double
    float offset;        // -cos(outer) * scale
    uint area;           // index into the rectangles, kNoArea; these shine ahead alone
    float padding0;
    float padding1;
};
FROXEL_SIZE_ASSERT(Spot, 32);

struct DirectionalLight {
    vec3 direction_view; // unit, the way the light travels
    float padding0;
    vec3 color; // linear, times intensity
    float padding1;
};
FROXEL_SIZE_ASSERT(DirectionalLight, 32);

// One cluster's run in the light index list; light indices ascend.
struct ClusterList {
    uint offset;
    uint count;
};
FROXEL_SIZE_ASSERT(ClusterList, 8);

FROXEL_IO_NAMESPACE_END

#endif

// Rectangular lights, and the table of linearly transformed cosines that their highlights take.
#ifndef FROXEL_INTERFACE_AREA_IO_H
#define FROXEL_INTERFACE_AREA_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

// One texel after another; a light's Spot says which. It shines from half_right x half_up's other
// side: along the spot's direction.
struct AreaLight {
    vec3 half_right_view; // m, from the centre to the middle of an edge
    float inv_area;       // 1/m^2
    vec3 half_up_view;
    float padding0;
};
FROXEL_SIZE_ASSERT(AreaLight, 32);

FROXEL_CONST uint kNoArea = 0xffffffffU;

// Entries of two texels, (a, b, c, d) and (albedo, grazing, 0, 0): of each lobe kLtcSize rows by
// roughness, kLtcLeastRoughness to 1, of kLtcSize entries by sqrt(1 - n.v), 0 to 1.
FROXEL_CONST uint kLtcSize = 32U;
FROXEL_CONST uint kLtcTexels = 2U;
FROXEL_CONST float kLtcLeastRoughness = 0.045F;

FROXEL_IO_NAMESPACE_END

#endif

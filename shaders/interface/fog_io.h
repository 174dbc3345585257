// What the passes of fog know, and every shader that looks through it (scalar block layout).
#ifndef FROXEL_INTERFACE_FOG_IO_H
#define FROXEL_INTERFACE_FOG_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

// Of the output flags of the shaders that look through fog or fill its volume; clear of the others.
FROXEL_CONST uint kOutputFog = 1U << 28;       // what is drawn is seen through it
FROXEL_CONST uint kOutputFogVolume = 1U << 29; // and lights are scattered, in a volume
FROXEL_CONST uint kOutputFogNoise = 1U << 30;  // whose samples are jittered

// The volume has a node each `tile_px` pixels, the last ones at the picture's last column and row,
// and `slice_count` slices to far_m, slice k from far_m (k / slice_count)^2 on. Its texel (x, y,
// z), x fastest, holds what lights scatter to the eye in front of the end of slice z: rgb.
struct Fog {
    float density; // settings::Fog
    float height_falloff;
    float eye_height_m; // above the base height
    float anisotropy;
    vec3 albedo;
    float far_m;  // beyond it no light is scattered
    vec3 ambient; // mean radiance from all around
    uint tile_px;
    uint node_count_x;
    uint node_count_y;
    uint slice_count;
    uint seed; // of the jitter
};
FROXEL_SIZE_ASSERT(Fog, 64);

FROXEL_IO_NAMESPACE_END

#endif

// Shadow maps: a table of the lights that have them, and how depths lie in the atlas.
#ifndef FROXEL_INTERFACE_SHADOW_IO_H
#define FROXEL_INTERFACE_SHADOW_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

FROXEL_CONST uint kNoShadow = 0xffffffffU; // of a light: it has no map
FROXEL_CONST uint kMaxShadowLights = 32U;
FROXEL_CONST uint kShadowLevels = 15U;  // how much of a light arrives: 4 bits, 15 is all of it
FROXEL_CONST uint kShadowColumns = 16U; // square tiles of the atlas beside each other
FROXEL_CONST uint kShadowTexels = 5U;   // 16 bytes each, of a ShadowLight
// Around what a face of a cube shows, in texels: an offset receiver stays on its face.
FROXEL_CONST uint kShadowBorder = 5U;
// A stored depth is this share of the light's reach over the distance along the face's axis.
FROXEL_CONST float kShadowNear = 1e-3F;
FROXEL_CONST float kShadowSlack = 1.0001F; // of that comparison, for its rounding
// A receiver is moved along its normal by texel * (constant + slope * (|n_u| + |n_v|)).
FROXEL_CONST float kShadowBias = 0.5F;
FROXEL_CONST float kShadowSlopeBias = 1.5F;

// A light with maps. Its frame: the world's axes for a cube of six faces, +x -x +y -y +z -z; for a
// spot right, up, and +z the way it shines, with that face alone. Along a face's axis `m`, `u` and
// `v` are the next two axes, cyclically: texel = (0.5 + 0.5 * scale * (u, v) / m) * size_px.
struct ShadowLight {
    vec3 x_view; // the frame's axes, unit
    float first_tile;
    vec3 y_view;
    float face_count; // 6, or 1
    vec3 z_view;
    float size_px;
    vec3 position_view; // as io::Light
    float inv_radius2;
    float scale;
    float texel;     // of a map, metres at a metre along its axis
    float near_m;    // kShadowNear * reach * kShadowSlack
    float transmits; // 1: some of its casters let light pass
};
FROXEL_SIZE_ASSERT(ShadowLight, 80);

FROXEL_IO_NAMESPACE_END

#endif

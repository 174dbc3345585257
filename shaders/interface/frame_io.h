// What every pass of a frame knows (scalar block layout).
#ifndef FROXEL_INTERFACE_FRAME_IO_H
#define FROXEL_INTERFACE_FRAME_IO_H

#include "compat.h"
#include "material_factors.h"
#include "material_slots.h"
#include "constants.h"

FROXEL_IO_NAMESPACE_BEGIN

// Cubic y = ((a u + b) u + c) u + d with u = x - x0, for x >= x0 up to the next segment.
struct ToonSegment {
    float x0;
    float a;
    float b;
    float c;
    float d;
};
FROXEL_SIZE_ASSERT(ToonSegment, 20);

// All that passes that draw surfaces know of a frame: while it stays, so may what they drew.
struct FrameCamera {
    // clip = (xy * clip_scale + clip_offset * w, clip_z.x + clip_z.y * z, w)
    // w = clip_w.x + clip_w.y * z
    vec2 clip_scale;
    vec2 clip_offset; // of an off-centre frustum
    vec2 clip_z;
    vec2 clip_w;
    // distance along the view axis = (num.x + num.y * depth) / (den.x + den.y * depth)
    vec2 distance_num;
    vec2 distance_den;
    // ray = (pixel + 0.5) * ray_scale + ray_offset
    // xy_view = ray * (spread.x + spread.y * distance)
    vec2 ray_scale;
    vec2 ray_offset;
    vec2 ray_spread;
    uint width_px;
    uint height_px;
    float orthographic; // 1: all view rays are parallel
    float geometry_error_px;
};
FROXEL_SIZE_ASSERT(FrameCamera, 88);

struct Frame {
    FrameCamera camera;
    uint tile_width_px;
    uint tile_height_px;
    uint tile_count_x;
    uint tile_count_y;
    uint slice_count;
    uint light_count;
    uint directional_count;
    // cluster::SliceLaw: slice = key(distance) * scale >> (32 + shift)
    uint slice_first;
    uint slice_scale;
    uint slice_shift;
    vec3 up_view;     // world up
    float exposure;   // where it is metered, as it was asked for until then
    vec3 ambient_sky; // linear radiance from above
    vec3 ambient_ground;
    float slice_unit;
    vec3 background;         // linear, of the display: halfway up the picture
    float light_inv_radius2; // of every local light, where they are equal
    uint first_area;         // the first light that may be a rectangle
    float outline_strength;
    float outline_reach_px;    // how far from an edge pixels are darkened
    float light_most_inverse2; // of a small scene: 1 / light::nearestDistance()^2
    float background_gradient; // how much more of it is at the top, and less at the bottom
    ToonSegment toon[kMaxToonSegments];
    float toon_bands;
    float toon_band;         // 1 / toon_bands
    float toon_brightest;    // 1 / (toon_bands - 0.5)^2
    float toon_least_middle; // of a light's bands, irradiance per candela: however far it reaches
    float toon_rim;          // what a rim scatters, as a multiple of what others do
    float toon_rim_width;    // n.v below which a surface is a rim
};
FROXEL_SIZE_ASSERT(Frame, 412);

// One textured slot's uv_texture = (dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z).
struct UvTransform {
    vec3 row0;
    vec3 row1;
    uint texcoord;
    float padding0;
};
FROXEL_SIZE_ASSERT(UvTransform, 32);

struct Material {
    vec4 base_color;
    vec3 emissive;
    float metallic;
    float roughness;
    float normal_scale;
    float occlusion_strength;
    float alpha_cutoff;
    vec3 specular_f0; // what the index of refraction gives head-on, times the specular colour
    float specular;   // its strength
    float ior;        // 1 and more
    float padding0;
    float padding1;
    float padding2;
#define FROXEL_MEMBER(type, name) type name;
    FROXEL_MATERIAL_FACTORS(FROXEL_MEMBER)
#undef FROXEL_MEMBER
    UvTransform uv[kMaterialSlots];
};
#define FROXEL_BYTES(type, name) +sizeof(type)
FROXEL_SIZE_ASSERT(Material, 80 FROXEL_MATERIAL_FACTORS(FROXEL_BYTES) + 32 * kMaterialSlots);
#undef FROXEL_BYTES

FROXEL_IO_NAMESPACE_END

#endif

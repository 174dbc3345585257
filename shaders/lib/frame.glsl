// Set 0: the frame, its lights and lists; and the geometry of a pixel.
#include "interface/frame_bindings.h"
#include "interface/frame_io.h"
#include "interface/light_io.h"
#include "interface/shadow_io.h"

layout(constant_id = 0) const uint MATERIAL_FLAGS = 0;
layout(constant_id = 1) const uint LIGHT_FLAGS = 0;
layout(constant_id = 2) const uint OUTPUT_FLAGS = 0;
layout(constant_id = 3) const uint BATCH_SIZE = 8;
layout(constant_id = 4) const uint MATERIAL_TEXTURES = 0;

#ifdef FROXEL_CAMERA_ALONE
// Of passes whose results are kept while what they read stays.
struct FrameOfSurfaces {
    FrameCamera camera;
};
layout(set = 0, binding = kFrameBinding, scalar) uniform FrameBlock { FrameOfSurfaces frame; };
#else
layout(set = 0, binding = kFrameBinding, scalar) uniform FrameBlock { Frame frame; };
#endif
// Texel buffers: a software rasteriser gathers from these without a branch for each invocation,
// four times cheaper than from storage buffers.
layout(set = 0, binding = kLightsBinding) uniform textureBuffer light_texels; // io::Light: 2 texels
layout(set = 0, binding = kListsBinding) uniform utextureBuffer list_texels;  // io::ClusterList
layout(set = 0, binding = kIndicesBinding) uniform utextureBuffer index_texels; // light index list
layout(set = 0, binding = kSpotsBinding) uniform textureBuffer spot_texels; // io::Spot: 2 texels
layout(set = 0, binding = kSunsBinding, scalar) readonly buffer SunBlock {
    DirectionalLight suns[];
};
layout(set = 0,
       binding = kShadowOfLightBinding) uniform utextureBuffer shadow_of_light; // or kNoShadow
layout(set = 0, binding = kShadowLightsBinding) uniform textureBuffer
    shadow_texels; // io::ShadowLight: 5 texels
layout(set = 0, binding = kShadowAtlasBinding) uniform texture2D shadow_atlas;
layout(set = 0,
       binding = kAreasBinding) uniform textureBuffer area_texels; // io::AreaLight: 2 texels
layout(set = 0, binding = kLtcBinding) uniform textureBuffer ltc_texels;
layout(set = 0, binding = kTransmittanceAtlasBinding) uniform texture2D transmittance_atlas;
layout(set = 0, binding = kTransmissiveDepthBinding) uniform texture2D transmissive_depth;

#ifdef FROXEL_VISIBILITY
// Of this invocation's pixel; the constants: what any of them may have.
uint visible_flags;
uint visible_textures;
bool hasMaterial(uint flag) { return (MATERIAL_FLAGS & visible_flags & flag) != 0; }
bool hasTexture(uint slot) { return (MATERIAL_TEXTURES & visible_textures & 1u << slot) != 0; }
#else
bool hasMaterial(uint flag) { return (MATERIAL_FLAGS & flag) != 0; }
bool hasTexture(uint slot) { return (MATERIAL_TEXTURES & 1u << slot) != 0; }
#endif
bool hasLight(uint flag) { return (LIGHT_FLAGS & flag) != 0; }
bool hasOutput(uint flag) { return (OUTPUT_FLAGS & flag) != 0; }

// Metres along the view axis; depth > 0.
float distanceFromDepth(float depth) {
    return (frame.camera.distance_num.x + frame.camera.distance_num.y * depth) /
           (frame.camera.distance_den.x + frame.camera.distance_den.y * depth);
}

// The same bits in every renderer: from the integer pixel and the distance alone.
vec3 positionFromDistance(uvec2 pixel, float distance) {
    precise vec2 ray = (vec2(pixel) + 0.5) * frame.camera.ray_scale + frame.camera.ray_offset;
    precise vec2 xy = ray * (frame.camera.ray_spread.x + frame.camera.ray_spread.y * distance);
    return vec3(xy, -distance);
}

#ifndef FROXEL_CAMERA_ALONE
const uint kNoCluster = 0xffffffffu;

// A depth in fixed point: the unit is a power of two, so nothing rounds but the conversion, down.
uint fixedPoint(float distance) { return uint(min(distance * frame.slice_unit, 2147483520.0)); }

// Grows with distance, by the law of the grid; the formulas are cluster::SliceLaw's.
uint sliceKey(float distance) {
    if (hasLight(kLightSlicesHyperbolic)) {
        uint left = 0xffffffffu / max(fixedPoint(distance), 1u);
        return frame.slice_first - min(left, frame.slice_first);
    }
    uint key = hasLight(kLightSlicesLinear) ? fixedPoint(distance) : floatBitsToUint(distance);
    return max(key, frame.slice_first) - frame.slice_first;
}

// The cluster of a pixel at a distance; kNoCluster beyond the grid, where no light reaches. In
// integers, so that it is what the assignment took it to be.
uint clusterAt(uvec2 pixel, float distance) {
    uint slice;
    uint fraction;
    umulExtended(sliceKey(distance), frame.slice_scale, slice, fraction);
    slice >>= frame.slice_shift;
    uvec2 tile = pixel / uvec2(frame.tile_width_px, frame.tile_height_px);
    uint cluster = (slice * frame.tile_count_y + tile.y) * frame.tile_count_x + tile.x;
    return slice < frame.slice_count ? cluster : kNoCluster;
}

// A Hermite ramp as cubics; x in [0, inf). Unused segments start beyond any x.
float toonRamp(float x) {
    ToonSegment s = frame.toon[0];
    for (uint i = 1; i < kMaxToonSegments; ++i) {
        if (x >= frame.toon[i].x0) {
            s = frame.toon[i];
        }
    }
    precise float u = x - s.x0;
    precise float y = fma(fma(fma(s.a, u, s.b), u, s.c), u, s.d);
    return y;
}

// The middle of the band that `light` lies in; nothing stays nothing. Bands are of equal width in
// the square root of light / (light + middle), or of the light itself where middle is 0: then it is
// a share, of which 1 stays 1.
float toonBand(float light, float middle) {
    precise float share = middle > 0.0 ? light / (light + middle) : light;
    precise float band = min(floor(sqrt(share) * frame.toon_bands), frame.toon_bands - 1.0) + 0.5;
    precise float center = band * frame.toon_band;
    precise float squared = center * center;
    precise float level =
        middle > 0.0 ? middle * squared / (1.0 - squared) : band * band * frame.toon_brightest;
    return light > 0.0 ? level : 0.0;
}
#endif

// A debug view of the solid surfaces: one value a pixel, out of what the frame has anyway.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "interface/debug_io.h"
#include "interface/heat_map.h"
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/light_loop.glsl"
#include "lib/pair_count.glsl"
#include "lib/tonemap.glsl"
#include "lib/screen.glsl"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;
layout(push_constant, scalar) uniform DebugBlock { DebugFrame debug; };

// No material has a say here: its constant is which view.
const uint kView = MATERIAL_FLAGS;

uint color(vec3 c) { return packUnorm4x8(vec4(c, 1.0)); }

uint heatOfCount(uint count) { return heatColor(heatPosition(count, debug.count_max)); }

uint heatOf(float value) {
    return heatColor(uint(clamp(value / debug.scale_max, 0.0, 1.0) * float(kHeatTop)));
}

vec3 toWorld(vec3 v) {
    return vec3(dot(debug.world_x.xyz, v), dot(debug.world_y.xyz, v), dot(debug.world_z.xyz, v));
}

// The picture four times across and down at a quarter of its size; byte x of word y. Cells that the
// target has no byte for are empty.
uint byteMosaic(uvec2 pixel) {
    uvec2 cell_size = max(uvec2(frame.camera.width_px, frame.camera.height_px) / 4u, 1u);
    uvec2 cell = pixel / cell_size;
    if (any(greaterThan(cell, uvec2(3u))) || 4u * cell.y + cell.x >= debug.byte_count) {
        return kDebugEmpty;
    }
    ivec2 source = ivec2((pixel - cell * cell_size) * 4u);
    if (texelFetch(depth_image, source, 0).x <= 0.0) {
        return kDebugEmpty;
    }
    uvec4 words = kView == kDebugGbuffer ? texelFetch(gbuffer_image, source, 0)
                                         : texelFetch(extra_image, source, 0);
    uint value = (words[cell.y] >> (8u * cell.x)) & 255u;
    return 0xff000000u | value * 0x010101u;
}

uint instanceColor(uint number) {
    return kDebugEmpty ^ ((number * kInstanceColorFactor) & kInstanceColorMask);
}

uint tileColor(uvec2 pixel) {
    uvec2 tile = pixel / uvec2(frame.tile_width_px, frame.tile_height_px);
    uvec2 last = max(uvec2(frame.tile_count_x, frame.tile_count_y) - 1u, 1u);
    uvec2 share = tile * 255u / last;
    return 0xff000000u | share.x | (share.y << 8) | (((tile.x + tile.y) & 1u) * 96u) << 16;
}

uint sliceColor(float distance) {
    uint cluster = clusterAt(uvec2(0u), distance);
    if (!hasLight(kLightLists) || cluster == kNoCluster) {
        return kDebugEmpty;
    }
    return heatOfCount(cluster / (frame.tile_count_x * frame.tile_count_y));
}

uint lightsColor(uvec2 pixel, float distance) {
    ClusterList list = ClusterList(0u, 0u);
    if (hasLight(kLightLocal)) {
        list = handedList(pixel, distance);
    }
    if (kView == kDebugListedLights || kView == kDebugEvaluatedLights) {
        return heatOfCount(list.count);
    }
    uint reaching = countReaching(list, positionFromDistance(pixel, distance));
    if (kView == kDebugContributingLights) {
        return heatOfCount(reaching);
    }
    return heatColor(heatPosition(list.count - reaching, max(list.count, 1u)));
}

uint materialColor(uvec2 pixel, uvec4 extra) {
    GbufferSample g = unpackGbuffer(texelFetch(gbuffer_image, ivec2(pixel), 0), extra);
    switch (kView) {
    case kDebugNormal:
        return color(fma(toWorld(g.normal_view), vec3(0.5), vec3(0.5)));
    case kDebugBaseColor:
        return color(srgbEncode(g.base_color));
    default:
        return color(vec3(g.occlusion, g.roughness, g.metallic));
    }
}

uint surfaceColor(uvec2 pixel, float depth) {
    uvec4 extra = uvec4(0u);
    if (readsExtra()) {
        extra = texelFetch(extra_image, ivec2(pixel), 0);
    }
    float distance = distanceFromDepth(depth);
    switch (kView) {
    case kDebugPosition: {
        vec3 p = toWorld(extraPosition(extra, positionFromDistance(pixel, distance))) +
                 vec3(debug.world_x.w, debug.world_y.w, debug.world_z.w);
        return color(p * debug.inverse_box);
    }
    case kDebugDepth:
        return heatOf(distance);
    case kDebugClusterSlices:
        return sliceColor(distance);
    case kDebugNormal:
    case kDebugBaseColor:
    case kDebugRoughness:
        return materialColor(pixel, extra);
    default:
        return lightsColor(pixel, distance);
    }
}

uint debugColor(uvec2 pixel) {
    switch (kView) {
    case kDebugGbuffer:
    case kDebugGbufferExtra:
        return byteMosaic(pixel);
    case kDebugClusterTiles:
        return tileColor(pixel);
    case kDebugOverdraw:
        return heatOfCount(uint(imageLoad(radiance_image, ivec2(pixel)).x));
    case kDebugInstances:
        return instanceColor(uint(imageLoad(radiance_image, ivec2(pixel)).x));
    default:
        break;
    }
    float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
    return depth > 0.0 ? surfaceColor(pixel, depth) : kDebugEmpty;
}

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (insideScreen(pixel)) {
        pixels[pixel.y * frame.camera.width_px + pixel.x] = debugColor(pixel);
    }
}

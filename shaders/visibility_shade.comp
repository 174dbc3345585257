// forward.frag's twin in compute: from ids of triangles to radiance. Of solid surfaces; or, with
// FROXEL_TRANSMISSION, of one layer of surfaces that transmit light, over what is there.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#ifdef FROXEL_BINDLESS
#extension GL_EXT_nonuniform_qualifier : require
#endif
#ifdef FROXEL_SUBGROUPS
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_vote : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#endif
#include "lib/frame.glsl"
#include "lib/surface_radiance.glsl"
#include "lib/tonemap.glsl"
#include "lib/screen.glsl"
#include "lib/pixel_order.glsl"
#include "lib/visibility_set.glsl"
#include "lib/material.glsl"
#include "lib/visibility_surface.glsl"
#include "lib/visibility_resolve.glsl"

layout(local_size_x = 64) in;

#ifdef FROXEL_TRANSMISSION
#include "lib/fog.glsl"
#include "lib/object_from_view.glsl"
#define FROXEL_BEHIND_SET 4
#include "lib/transmission.glsl"

// Pictures of a layer each, the nearest first: of a pixel its id and its depth's bits, 0 where it
// is empty.
layout(set = 2, binding = 15, scalar) readonly buffer LayerBlock { uvec2 layer_words[]; };
#define FROXEL_TILES_BINDING 24
#include "lib/layer_tiles.glsl"

uint layerNumber() { return resolve_flags >> kResolveLayerShift; }

uvec2 groupsTile() {
    bool listed = (resolve_flags & kResolveTiles) != 0u;
    return listed ? layerTile(layerNumber(), gl_WorkGroupID.x) : gl_WorkGroupID.xy;
}

uvec2 layerWord(uvec2 pixel) {
    uvec2 size = uvec2(frame.camera.width_px, frame.camera.height_px);
    return layer_words[(layerNumber() * size.y + pixel.y) * size.x + pixel.x];
}

float depthOf(uvec2 pixel) { return uintBitsToFloat(layerWord(pixel).y); }
uint idOf(uvec2 pixel) { return layerWord(pixel).x; }

// Whether a pixel that is lit together with this one is.
bool anyNearby(bool covered) {
#ifdef FROXEL_SUBGROUPS
    return subgroupAny(covered);
#else
    return covered;
#endif
}

float distanceOf(VisibleTriangle t, uvec2 pixel, float depth) {
    return planeDistance(t, pixel, distanceFromDepth(depth));
}

float layer_alpha = 1.0;
mat3 object_from_view = mat3(0.0);

void keepForLayer(VisibleTriangle t, vec4 base) {
    layer_alpha = hasMaterial(kMaterialBlend) ? clamp(base.a, 0.0, 1.0) : 1.0;
    InstanceView view = instances[items[t.item].instance];
    object_from_view = objectFromView(view.row0.xyz, view.row1.xyz, view.row2.xyz);
}

void storeLit(uvec2 pixel, bool covered, float depth, float distance, GbufferSample g, Surface s,
              LightSum sum) {
    if (!covered) {
        return;
    }
    vec3 behind =
        broughtBehind(s, g.layers.transmission, pixel, depth, distance, object_from_view, sum);
    vec3 lit = throughFog(surfaceRadiance(g, s, sum, behind), pixel, distance);
    vec4 before = imageLoad(radiance_image, ivec2(pixel));
    imageStore(radiance_image, ivec2(pixel),
               vec4(lit, 1.0) * layer_alpha + before * (1.0 - layer_alpha));
}
#else
uvec2 groupsTile() { return gl_WorkGroupID.xy; }
bool anyNearby(bool covered) { return true; }

float depthOf(uvec2 pixel) { return texelFetch(depth_image, ivec2(pixel), 0).x; }
uint idOf(uvec2 pixel) { return texelFetch(id_image, ivec2(pixel), 0).x; }

float distanceOf(VisibleTriangle t, uvec2 pixel, float depth) {
    return solidDistance(t, pixel, depth);
}

void keepForLayer(VisibleTriangle t, vec4 base) {}

void storeLit(uvec2 pixel, bool covered, float depth, float distance, GbufferSample g, Surface s,
              LightSum sum) {
    vec3 lit = g.unlit ? g.base_color : surfaceRadiance(g, s, sum);
    vec4 radiance = covered ? vec4(lit, radianceAlpha(g)) : vec4(0.0);
    bool fills = depth == 0.0 && (resolve_flags & kResolveLast) != 0u;
    if (insideScreen(pixel) && (covered || fills)) {
        if (hasOutput(kOutputRadiance)) {
            imageStore(radiance_image, ivec2(pixel), radiance);
        }
        if (hasOutput(kOutputPixels)) {
            storePixel(pixel, radiance);
        }
    }
}
#endif

// Where this dispatch shades nothing.
GbufferSample emptySample() {
    GbufferSample g;
    g.normal_view = vec3(0.0, 0.0, 1.0);
    g.base_color = g.emissive = vec3(0.0);
    g.roughness = g.occlusion = 1.0;
    g.metallic = 0.0;
    g.unlit = false;
    g.dielectric = usualDielectric();
#ifdef FROXEL_LAYERED
    g.layers = noLayers(g.normal_view);
    visible_flags = 0u;
#endif
    return g;
}

void main() {
    uvec2 pixel = groupsTile() * kScreenGroup + pixelInGroup(gl_LocalInvocationIndex);
    float depth = insideScreen(pixel) ? depthOf(pixel) : 0.0;
    bool covered = depth > 0.0;
    uint id = covered ? idOf(pixel) : 0u;
    covered = covered && mine(id);
    if (!anyNearby(covered)) {
        return;
    }
    float distance = distanceFromDepth(1.0);
    vec3 position = positionFromDistance(pixel, distance);
    GbufferSample g = emptySample();
    if (covered) {
        VisibleTriangle t = fetchTriangle(id);
        distance = distanceOf(t, pixel, depth);
        position = positionFromDistance(pixel, distance);
        bool front;
        VertexData v = fetchSurface(t, pixel, front);
        vec4 base = baseColor(v);
        g = shadeMaterial(v, base, position, front);
        keepForLayer(t, base);
    }
    Surface s = makeSurface(position, g.normal_view, g.roughness);
#ifdef FROXEL_LAYERED
    addLayers(g.layers, s);
#endif
    LightSum sum = sumLights(s, pixel, distance, covered && !g.unlit);
    storeLit(pixel, covered, depth, distance, g, s, sum);
}

// What compute rastered of several layers, made ready for those that shade them: drops layers that
// a solid surface hides, which no nearer one follows, and lists the tiles of each layer. With
// FROXEL_DEPTH writes the depth of the nearest layers.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_image_load_formatted : require
#extension GL_GOOGLE_include_directive : require
#define FROXEL_CAMERA_ALONE
#define FROXEL_PEELED
#include "lib/frame.glsl"
#include "lib/screen.glsl"
#include "lib/raster_set.glsl"
#define FROXEL_TILES_BINDING 24
#include "lib/layer_tiles.glsl"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;
#ifdef FROXEL_DEPTH
layout(set = 2, binding = 19) uniform writeonly image2D depth_store;
// In other rows there is nothing, and words are not cleared.
layout(push_constant) uniform RowsBlock {
    uint first_row;
    uint end_row;
};
bool hasWords(uvec2 pixel) { return pixel.y >= first_row && pixel.y < end_row; }
#else
bool hasWords(uvec2 pixel) { return true; }
#endif

shared uint tile_layers; // a bit for each that has pixels

// The bits of a pixel's layers; nearest: their first depth.
uint keepLayers(uvec2 pixel, out float nearest) {
    uint place = pixel.y * frame.camera.width_px + pixel.x;
    uint pixel_count = frame.camera.width_px * frame.camera.height_px;
    float solid = texelFetch(depth_image, ivec2(pixel), 0).x;
    uint kept = 0u;
    nearest = 0.0;
    for (uint layer = 0; layer < layerCount(); ++layer) {
        uint at = layer * pixel_count + place;
        float depth = uintBitsToFloat(uint(words[at] >> 32));
        if (depth == 0.0) {
            break;
        }
        if (depth < solid) {
            words[at] = 0;
        } else {
            nearest = max(nearest, depth);
            kept |= 1u << layer;
        }
    }
    return kept;
}

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (gl_LocalInvocationIndex == 0u) {
        tile_layers = 0u;
    }
    barrier();
    if (insideScreen(pixel)) {
        float nearest = 0.0;
        if (hasWords(pixel)) {
            atomicOr(tile_layers, keepLayers(pixel, nearest));
        }
#ifdef FROXEL_DEPTH
        imageStore(depth_store, ivec2(pixel), vec4(nearest));
#endif
    }
    barrier();
    uint layer = gl_LocalInvocationIndex;
    if (layer < layerCount() && (tile_layers & (1u << layer)) != 0u) {
        listTile(layer, gl_WorkGroupID.xy);
    }
}

// The picture as surfaces that transmit light see it behind them: all of it is radiance, also what
// is unlit and what the background shows where nothing is. Alpha: how much of the background is
// covered.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/frame.glsl"
#include "lib/tonemap.glsl"
#include "lib/screen.glsl"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;

layout(set = 2, binding = 1, rgba32f) uniform writeonly image2D behind_image;

#ifdef FROXEL_TILES
#define FROXEL_TILES_BINDING 2
#include "lib/layer_tiles.glsl"
// What changed since the last copy: where this layer was drawn.
layout(push_constant) uniform LayerBlock { uint layer; };
uvec2 groupsTile() { return layerTile(layer, gl_WorkGroupID.x); }
#else
uvec2 groupsTile() { return gl_WorkGroupID.xy; }
#endif

void main() {
    uvec2 pixel = groupsTile() * kScreenGroup + gl_LocalInvocationID.xy;
    if (!insideScreen(pixel)) {
        return;
    }
    vec4 seen = imageLoad(radiance_image, ivec2(pixel)); // alpha: radianceAlpha()
    if (seen.a < 1.0) {
        seen.rgb += (1.0 - seen.a) * shownAs(backgroundAt(pixel.y, frame.camera.height_px));
    } else if (seen.a > 1.0) {
        seen.rgb = mix(seen.rgb, shownAs(seen.rgb), seen.a - 1.0);
    }
    imageStore(behind_image, ivec2(pixel), vec4(seen.rgb, min(seen.a, 1.0)));
}

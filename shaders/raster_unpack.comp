// From the words that compute rastered to depths and ids, for whoever reads the rasteriser's.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_image_load_formatted : require
#extension GL_GOOGLE_include_directive : require
#define FROXEL_CAMERA_ALONE
#include "lib/frame.glsl"
#include "lib/raster_set.glsl"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;
layout(set = 2, binding = 19) uniform writeonly image2D depth_store;
layout(set = 2, binding = 20) uniform writeonly uimage2D id_store;

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(pixel, uvec2(frame.camera.width_px, frame.camera.height_px)))) {
        return;
    }
    uint64_t word = words[pixel.y * frame.camera.width_px + pixel.x];
    imageStore(depth_store, ivec2(pixel), vec4(uintBitsToFloat(uint(word >> 32))));
    imageStore(id_store, ivec2(pixel), uvec4(uint(word)));
}

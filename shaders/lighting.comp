// Lighting pass of the deferred renderers, one invocation a pixel. A subgroup covers a block of
// pixels close together, so that its lists are mostly one list.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
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
#include "lib/deferred.glsl"

layout(local_size_x = 64) in;

void main() {
    uvec2 pixel = gl_WorkGroupID.xy * kScreenGroup + pixelInGroup(gl_LocalInvocationIndex);
    bool inside = insideScreen(pixel);
    vec4 radiance = lightPixel(pixel, inside);
    if (inside) {
        if (hasOutput(kOutputRadiance)) {
            imageStore(radiance_image, ivec2(pixel), radiance);
        }
        if (hasOutput(kOutputPixels)) {
            storePixel(pixel, radiance);
        }
    }
}

// What is around behind the scene: where no surface is.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/frame.glsl"
#include "lib/tonemap.glsl"
#include "lib/screen.glsl"
#include "lib/environment_map.glsl"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (insideScreen(pixel) && texelFetch(depth_image, ivec2(pixel), 0).x == 0.0) {
        vec3 ray = frame.camera.orthographic != 0.0 ? vec3(0.0, 0.0, -1.0)
                                                    : positionFromDistance(pixel, 1.0);
        vec3 radiance = glossyRadiance(ray, environment.background_alpha);
        imageStore(radiance_image, ivec2(pixel), vec4(radiance, 1.0));
    }
}

// The visibility pass's geometry: a draw is one placed meshlet, named by its first instance. Masked
// materials carry what their alpha test reads.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#define FROXEL_CAMERA_ALONE
#include "lib/frame.glsl"
#include "lib/visibility_set.glsl"

layout(location = 0) in vec3 position_object;

layout(location = 5) flat out uint first_id;
#ifdef FROXEL_MASKED
layout(location = 2) in vec2 uv0_in;
layout(location = 1) out vec2 uv0;
#ifdef FROXEL_EXTENDED
layout(location = 6) in vec2 uv1_in;
layout(location = 7) in vec4 color_in;
layout(location = 2) out vec2 uv1;
layout(location = 3) out vec4 color;
#endif
#endif

vec4 view_from_object_0;
vec4 view_from_object_1;
vec4 view_from_object_2;
#include "lib/project.glsl"

void main() {
    InstanceView view = instances[items[placed_meshlets[gl_InstanceIndex].item].instance];
    view_from_object_0 = view.row0;
    view_from_object_1 = view.row1;
    view_from_object_2 = view.row2;
    gl_Position = project(toView(position_object));
    first_id = uint(gl_InstanceIndex) << kTriangleBits;
#ifdef FROXEL_MASKED
    uv0 = uv0_in;
#ifdef FROXEL_EXTENDED
    uv1 = uv1_in;
    color = color_in;
#endif
#endif
}

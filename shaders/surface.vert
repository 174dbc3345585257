// Geometry of every pass that shades: view-space normal and texture coordinates. The extended
// variant carries a second set, vertex colour and tangent; the untextured one fetches no
// coordinates.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#define FROXEL_CAMERA_ALONE
#include "lib/frame.glsl"

layout(location = 0) in vec3 position_object;
layout(location = 1) in vec3 normal_object;
#ifndef FROXEL_UNTEXTURED
layout(location = 2) in vec2 uv0_in;
#endif
layout(location = 3) in vec4 view_from_object_0;
layout(location = 4) in vec4 view_from_object_1;
layout(location = 5) in vec4 view_from_object_2;

layout(location = 0) out vec3 normal_view;
layout(location = 1) out vec2 uv0;
#ifdef FROXEL_EXTENDED
layout(location = 6) in vec2 uv1_in;
layout(location = 7) in vec4 color_in;
layout(location = 8) in vec4 tangent_object;
layout(location = 2) out vec2 uv1;
layout(location = 3) out vec4 color;
layout(location = 4) out vec4 tangent_view;
#endif

#ifdef FROXEL_TRANSMISSION
#include "lib/object_from_view.glsl"
layout(location = 5) flat out mat3 object_from_view;
#endif

#include "lib/project.glsl"

void main() {
    vec3 position_view = toView(position_object);
    gl_Position = project(position_view);
    vec3 r0 = view_from_object_0.xyz;
    vec3 r1 = view_from_object_1.xyz;
    vec3 r2 = view_from_object_2.xyz;
    // Rows of the cofactor matrix: the inverse transpose times the determinant, whose sign turns
    // the normals of mirrored nodes back.
    vec3 c0 = cross(r1, r2);
    float side = dot(r0, c0) < 0.0 ? -1.0 : 1.0;
    normal_view = side * vec3(dot(c0, normal_object), dot(cross(r2, r0), normal_object),
                              dot(cross(r0, r1), normal_object));
#ifdef FROXEL_TRANSMISSION
    object_from_view = objectFromView(r0, r1, r2);
#endif
#ifdef FROXEL_UNTEXTURED
    uv0 = vec2(0.0); // nothing looks at it
#else
    uv0 = uv0_in;
#endif
#ifdef FROXEL_EXTENDED
    uv1 = uv1_in;
    color = color_in;
    vec3 t =
        vec3(dot(r0, tangent_object.xyz), dot(r1, tangent_object.xyz), dot(r2, tangent_object.xyz));
    tangent_view = vec4(dot(t, t) > 0.0 ? normalize(t) : t, tangent_object.w * side);
#endif
}

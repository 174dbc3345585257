// The depth prepass; with texture coordinates for masked materials.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#define FROXEL_CAMERA_ALONE
#include "lib/frame.glsl"

layout(location = 0) in vec3 position_object;
layout(location = 3) in vec4 view_from_object_0;
layout(location = 4) in vec4 view_from_object_1;
layout(location = 5) in vec4 view_from_object_2;

#include "lib/project.glsl"

void main() { gl_Position = project(toView(position_object)); }

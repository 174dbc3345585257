// The lighting pass in the fragment stage; writes linear radiance.
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
#include "lib/deferred.glsl"

layout(location = 0) out vec4 radiance;

void main() { radiance = lightPixel(uvec2(gl_FragCoord.xy), true); }

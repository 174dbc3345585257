// Where a light ends: three great circles of its sphere, or of a spot's cone the rim and two cuts
// along the axis. An instance a light, a line two vertices.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "interface/debug_io.h"
#include "lib/frame.glsl"
#include "lib/clip.glsl"

layout(location = 0) out vec3 color;

// The k-th of two axes across `axis`.
vec3 across(vec3 axis, uint k) {
    vec3 u = normalize(cross(axis, abs(axis.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
    return k == 0u ? u : cross(axis, u);
}

vec3 onCircle(vec3 u, vec3 v, float turn) {
    float angle = 6.28318530718 * turn;
    return cos(angle) * u + sin(angle) * v;
}

vec3 onSphere(uint circle, float turn) {
    const vec3 axes[3] = vec3[3](vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0));
    return onCircle(axes[circle], axes[(circle + 1u) % 3u], turn);
}

// In units of the radius: the rim, or apex, rim, arc, rim and back.
vec3 onCone(vec3 axis, float cos_outer, uint circle, float turn) {
    float outer = acos(clamp(cos_outer, -1.0, 1.0));
    if (circle == 0u) {
        return cos_outer * axis + sin(outer) * onCircle(across(axis, 0u), across(axis, 1u), turn);
    }
    vec3 side = across(axis, circle - 1u);
    float angle = clamp((turn - 0.25) * 4.0 - 1.0, -1.0, 1.0) * outer;
    float reach = clamp(min(turn, 1.0 - turn) * 4.0, 0.0, 1.0);
    return reach * (cos(angle) * axis + sin(angle) * side);
}

void main() {
    vec4 reach = texelFetch(light_texels, 2 * gl_InstanceIndex);
    vec4 colors = texelFetch(light_texels, 2 * gl_InstanceIndex + 1);
    uint segment = uint(gl_VertexIndex) / 2u % kWireSegments;
    uint circle = uint(gl_VertexIndex) / (2u * kWireSegments);
    float turn = float(segment + uint(gl_VertexIndex) % 2u) / float(kWireSegments);
    uint spot = floatBitsToUint(colors.w);
    vec3 offset;
    if (spot == kNoSpot) {
        offset = onSphere(circle, turn);
    } else {
        vec4 a = texelFetch(spot_texels, int(2u * spot));
        vec4 b = texelFetch(spot_texels, int(2u * spot + 1u));
        offset = onCone(a.xyz, -b.x / a.w, circle, turn);
    }
    float brightest = max(max(colors.r, colors.g), colors.b);
    color = brightest > 0.0 ? colors.rgb / brightest : vec3(1.0);
    // A light without a range has no end to show: its lines have no length.
    float radius = reach.w > 0.0 ? inversesqrt(reach.w) : 0.0;
    gl_Position = project(reach.xyz + radius * offset);
}

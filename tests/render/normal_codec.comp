// Sends normals through the G-buffer's words and back, as the geometry and lighting passes do.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"

layout(local_size_x = 64) in;
layout(set = 1, binding = 0, scalar) buffer NormalBlock {
    vec3 normals[];
};

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < normals.length()) {
        vec3 n = normals[i];
        GbufferSample g =
            GbufferSample(n, vec3(0.0), 0.0, 0.0, 1.0, false, vec3(0.0), usualDielectric());
        normals[i] = unpackGbuffer(packGbuffer(g), packExtra(g, vec3(0.0), 1.0)).normal_view;
    }
}

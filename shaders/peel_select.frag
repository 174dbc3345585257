// Depth peeling (Everitt 2001): the depth test keeps the nearest fragment behind the layers before,
// of equal depths the last drawn. To count what is left instead, the first one closes its pixel.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/frame.glsl"
#include "lib/before_transmissive.glsl"
#include "lib/peel.glsl"

#ifndef FROXEL_COUNT
layout(location = 0) out uvec2 selected;
#endif

void main() {
    uvec2 key = peelKey();
    if (!waitsForItsLayer(key) || !drawnNow(gl_FragCoord)) {
        discard;
    }
#ifdef FROXEL_COUNT
    gl_FragDepth = 1.0; // nothing is nearer, so one sample a pixel passes the test
#else
    selected = key;
#endif
}

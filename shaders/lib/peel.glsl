// A fragment's place among the blended ones of its pixel: by depth, of equal depths by the order
// drawn, in which a triangle covers a pixel at most once. So places are distinct.
#include "interface/peel_io.h"

layout(set = 2, binding = 0) uniform texture2D solid_depth;
layout(set = 2, binding = 1) uniform utexture2D layer_keys; // last selected; 0, 0: none
layout(push_constant, scalar) uniform PeelBlock { PeelDraw peel; };

uint peelOrder() { return peel.first_triangle + uint(gl_PrimitiveID) + 1u; }

// Depths are not negative, so their bits are ordered as they are.
uvec2 peelKey() { return uvec2(floatBitsToUint(gl_FragCoord.z), peelOrder()); }

// Not hidden by a solid surface, and farther than all layers before.
bool waitsForItsLayer(uvec2 key) {
    ivec2 at = ivec2(gl_FragCoord.xy);
    if (gl_FragCoord.z < texelFetch(solid_depth, at, 0).r) {
        return false;
    }
    if (peel.layer == 0u) {
        return true;
    }
    uvec2 before = texelFetch(layer_keys, at, 0).rg;
    return key.x < before.x || (key.x == before.x && key.y < before.y);
}

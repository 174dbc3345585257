// What the debug pass is told, as push constants (scalar block layout).
#ifndef FROXEL_INTERFACE_DEBUG_IO_H
#define FROXEL_INTERFACE_DEBUG_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

// settings::DebugView, in its order; those over the picture have passes of their own.
FROXEL_CONST uint kDebugPosition = 1U;
FROXEL_CONST uint kDebugDepth = 2U;
FROXEL_CONST uint kDebugNormal = 3U;
FROXEL_CONST uint kDebugBaseColor = 4U;
FROXEL_CONST uint kDebugRoughness = 5U;
FROXEL_CONST uint kDebugGbuffer = 6U;
FROXEL_CONST uint kDebugGbufferExtra = 7U;
FROXEL_CONST uint kDebugClusterSlices = 8U;
FROXEL_CONST uint kDebugClusterTiles = 9U;
FROXEL_CONST uint kDebugListedLights = 10U;
FROXEL_CONST uint kDebugEvaluatedLights = 11U;
FROXEL_CONST uint kDebugContributingLights = 12U;
FROXEL_CONST uint kDebugFalsePositives = 13U;
FROXEL_CONST uint kDebugOverdraw = 14U;
FROXEL_CONST uint kDebugInstances = 17U;

FROXEL_CONST uint kDebugEmpty = 0xff202020U; // RGBA8 where there is nothing to show

// Where an instance is nearest: kDebugEmpty ^ (its number, from 1, times this, modulo 2^24). The
// factor is 2^24 divided by the golden ratio, which sets neighbouring numbers apart (Knuth, The Art
// of Computer Programming, 6.4), and odd, so that each number has its own colour.
FROXEL_CONST uint kInstanceColorFactor = 0x9e3779U;
FROXEL_CONST uint kInstanceColorMask = 0xffffffU;

// Push constants of a draw that stores its instance in the radiance target.
struct InstanceDraw {
    uint number; // from 1
};
FROXEL_SIZE_ASSERT(InstanceDraw, 4);

struct DebugFrame {
    // World axes in view space; w: the eye's distance from the scene's least corner along each.
    vec4 world_x;
    vec4 world_y;
    vec4 world_z;
    vec3 inverse_box; // 1/m, of the scene's box
    float scale_max;  // of values that are not counted
    uint count_max;   // of those that are
    uint byte_count;  // of a texel of the raw target
};
FROXEL_SIZE_ASSERT(DebugFrame, 72);

FROXEL_CONST uint kWireSegments = 48U; // lines a circle
FROXEL_CONST uint kWireCircles = 3U;   // a light
FROXEL_CONST uint kLinesOfALight = kWireSegments * kWireCircles;

// A corner of the cluster grid's wires.
struct WireVertex {
    vec3 position_view;
    uint color; // RGBA8
};
FROXEL_SIZE_ASSERT(WireVertex, 16);

FROXEL_IO_NAMESPACE_END

#endif

// Meshes that bend: what moves their vertices (scalar block layout).
#ifndef FROXEL_INTERFACE_POSE_IO_H
#define FROXEL_INTERFACE_POSE_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

FROXEL_CONST uint kPoseGroup = 64U; // vertices, or triangles, a workgroup
FROXEL_CONST uint kNoSkin = 0xffffffffU;

// Where a vertex's own begin in the tables; the next one's are where they end.
struct PoseRange {
    uint influence;
    uint delta;
};
FROXEL_SIZE_ASSERT(PoseRange, 8);

struct PoseInfluence {
    uint joint; // of the skin
    float weight;
};
FROXEL_SIZE_ASSERT(PoseInfluence, 8);

// What a morph target adds at a weight of 1.
struct PoseDelta {
    uint target;
    vec3 position;
    vec3 normal;
    vec3 tangent;
};
FROXEL_SIZE_ASSERT(PoseDelta, 40);

// By rows.
struct PoseJoint {
    vec4 row0;
    vec4 row1;
    vec4 row2;
};
FROXEL_SIZE_ASSERT(PoseJoint, 48);

// A primitive that bends.
struct PoseJob {
    uint first_vertex; // of the scene's streams
    uint vertex_count;
    uint first_range;
    uint first_joint;  // of the frame's; kNoSkin: it has none
    uint first_weight; // of the frame's, by target
    uint tangents;     // 1: it has some
    uint first_index;  // of the scene's, which count from first_vertex
    uint flat_count;   // triangles that give their corners a normal; 0: vertices have theirs
};
FROXEL_SIZE_ASSERT(PoseJob, 32);

FROXEL_IO_NAMESPACE_END

#endif

// What posing reads and writes: the scene's vertices at rest, what moves them, and the view's own.
#include "interface/pose_io.h"
#include "lib/vertex_streams.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer PositionBlock { vec3 rest_positions[]; };
layout(set = 0, binding = 1, scalar) readonly buffer SurfaceBlock {
    SurfaceVertex rest_surfaces[];
};
layout(set = 0, binding = 2, scalar) readonly buffer ExtendedBlock {
    ExtendedVertex rest_extended[];
};
layout(set = 0, binding = 3, scalar) readonly buffer IndexBlock { uint indices[]; };
layout(set = 0, binding = 4, scalar) readonly buffer RangeBlock { PoseRange ranges[]; };
layout(set = 0, binding = 5, scalar) readonly buffer InfluenceBlock { PoseInfluence influences[]; };
layout(set = 0, binding = 6, scalar) readonly buffer DeltaBlock { PoseDelta deltas[]; };
layout(set = 0, binding = 7, scalar) readonly buffer JointBlock { PoseJoint joints[]; };
layout(set = 0, binding = 8, scalar) readonly buffer WeightBlock { float weights[]; };
layout(set = 0, binding = 9, scalar) buffer PosedPositionBlock { vec3 posed_positions[]; };
layout(set = 0, binding = 10, scalar) buffer PosedSurfaceBlock { SurfaceVertex posed_surfaces[]; };
layout(set = 0, binding = 11, scalar) buffer PosedExtendedBlock {
    ExtendedVertex posed_extended[];
};

layout(push_constant, scalar) uniform JobBlock { PoseJob job; };

// Of a dispatch whose groups may need more than a row.
uint ownIndex() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    return group * kPoseGroup + gl_LocalInvocationIndex;
}

// Below infinity, and no NaN.
bool isNumber(float x) { return abs(x) <= 3.4e38; }

// What is unit as far as single precision goes stays to the bit: a pose at rest changes nothing.
vec3 unitOr(vec3 vector, vec3 otherwise) {
    float largest = max(max(abs(vector.x), abs(vector.y)), abs(vector.z));
    if (!(largest > 0.0 && isNumber(largest))) {
        return otherwise;
    }
    if (largest < 2.0 && abs(length(vector) - 1.0) <= 2e-7) {
        return vector;
    }
    vec3 scaled = vector / largest; // squares stay in range
    return scaled / length(scaled);
}

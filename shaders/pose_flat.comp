// Flat normals of a primitive that bends: those of the moved triangles, each of whose corners is a
// vertex of its own. One invocation a triangle.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "lib/pose_set.glsl"

layout(local_size_x = kPoseGroup) in;

void main() {
    uint triangle = ownIndex();
    if (triangle >= job.flat_count) {
        return;
    }
    uint first = job.first_index + 3u * triangle;
    uvec3 corners =
        job.first_vertex + uvec3(indices[first], indices[first + 1u], indices[first + 2u]);
    vec3 a = posed_positions[corners.x];
    vec3 ab = posed_positions[corners.y] - a;
    vec3 ac = posed_positions[corners.z] - a;
    // Along the same ways, of a length whose squares stay in range.
    vec3 across = cross(unitOr(ab, vec3(0.0)), unitOr(ac, vec3(0.0)));
    for (uint k = 0u; k < 3u; ++k) {
        posed_surfaces[corners[k]].normal = unitOr(across, posed_surfaces[corners[k]].normal);
    }
}

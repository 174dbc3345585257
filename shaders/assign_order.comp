// Light assignment, last pass for short lists, one workgroup a list: an index's place is the number
// of smaller ones. Quadratic, but read from shared memory by all invocations at once.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "lib/assign.glsl"

layout(local_size_x = 64) in;

shared uint words[kAssignShortList];

void main() {
    uint self = gl_LocalInvocationIndex;
    for (uint i = gl_WorkGroupID.x; i < totals.short_count; i += gl_NumWorkGroups.x) {
        ClusterList list = lists[queue[i]];
        barrier();
        for (uint k = self; k < list.count; k += kAssignGroup) {
            words[k] = raw_indices[list.offset + k];
        }
        barrier();
        for (uint k = self; k < list.count; k += kAssignGroup) {
            uint mine = words[k];
            uint rank = 0u;
            for (uint other = 0u; other < list.count; ++other) {
                rank += words[other] < mine ? 1u : 0u;
            }
            indices[list.offset + rank] = mine;
        }
    }
}

// Light assignment, last pass for short lists, one workgroup a list: sorts them by bucket in shared
// memory, and within a bucket by the number of smaller indices. A bucket is a run of light indices:
// few of a list, unless lights that come one after the other in the file lie close together.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "lib/assign.glsl"

layout(local_size_x = 64) in;

const uint kBucketsEach = kAssignBuckets / kAssignGroup;

shared uint words[kAssignShortList];
shared uint starts[kAssignBuckets];
shared uint cursors_of_bucket[kAssignBuckets];
shared uint sums[kAssignGroup];

// Turns the buckets' counts into where they start.
void placeBuckets() {
    uint self = gl_LocalInvocationIndex;
    uint sum = 0u;
    for (uint i = 0u; i < kBucketsEach; ++i) {
        sum += starts[self * kBucketsEach + i];
    }
    sums[self] = sum;
    for (uint step = 1u; step < kAssignGroup; step <<= 1u) {
        barrier();
        uint before = self >= step ? sums[self - step] : 0u;
        barrier();
        sums[self] += before;
    }
    uint at = sums[self] - sum;
    for (uint i = 0u; i < kBucketsEach; ++i) {
        uint bucket = self * kBucketsEach + i;
        uint count = starts[bucket];
        starts[bucket] = at;
        cursors_of_bucket[bucket] = at;
        at += count;
    }
    barrier();
}

void orderList(ClusterList list, uint shift) {
    uint self = gl_LocalInvocationIndex;
    barrier();
    for (uint i = self; i < kAssignBuckets; i += kAssignGroup) {
        starts[i] = 0u;
    }
    barrier();
    for (uint k = self; k < list.count; k += kAssignGroup) {
        atomicAdd(starts[raw_indices[list.offset + k] >> shift], 1u);
    }
    barrier();
    placeBuckets();
    for (uint k = self; k < list.count; k += kAssignGroup) {
        uint index = raw_indices[list.offset + k];
        words[atomicAdd(cursors_of_bucket[index >> shift], 1u)] = index;
    }
    barrier();
    for (uint k = self; k < list.count; k += kAssignGroup) {
        uint mine = words[k];
        uint first = starts[mine >> shift];
        uint end = cursors_of_bucket[mine >> shift];
        uint rank = first;
        for (uint other = first; other < end; ++other) {
            rank += words[other] < mine ? 1u : 0u;
        }
        indices[list.offset + rank] = mine;
    }
}

void main() {
    uint shift = uint(max(findMSB(max(frame.light_count, 1u) - 1u) + 1, 8) - 8);
    for (uint i = gl_WorkGroupID.x; i < totals.short_count; i += gl_NumWorkGroups.x) {
        orderList(lists[queue[i]], shift);
    }
}

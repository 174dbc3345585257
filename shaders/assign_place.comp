// Light assignment, fifth pass: gives every cluster its run in the light index list, and notes
// which runs are to be put in order.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "lib/assign.glsl"
#include "lib/assign_scan.glsl"

layout(local_size_x = 256) in;

shared uint counts[kAssignScanBlock];
shared uint short_total;
shared uint long_total;
shared uint short_base;
shared uint long_base;

// Without lists of its own each cluster has the one of all lights, or none.
void placeSame() {
    uint count = totals.outcome == kAssignAllLights ? frame.light_count : 0u;
    for (uint i = 0u; i < kAssignScanEach; ++i) {
        uint cluster = gl_WorkGroupID.x * kAssignScanBlock + i * kAssignScanGroup +
                       gl_LocalInvocationIndex;
        if (cluster < frame.cluster_count) {
            lists[cluster] = ClusterList(0u, count);
        }
    }
}

// Reserves the block's part of the queue of clusters to put in order.
void reserveQueue() {
    if (short_total > 0u) {
        short_base = atomicAdd(totals.short_count, short_total);
        atomicMax(totals.short_lists.x, min(short_base + short_total, kAssignMaxGroups));
    }
    if (long_total > 0u) {
        long_base = atomicAdd(totals.long_count, long_total);
        atomicMax(totals.long_lists.x, min(long_base + long_total, kAssignMaxGroups));
    }
}

void main() {
    if (totals.outcome != kAssignLists) {
        placeSame();
        return;
    }
    uint self = gl_LocalInvocationIndex;
    uint first = gl_WorkGroupID.x * kAssignScanBlock;
    if (self == 0u) {
        short_total = 0u;
        long_total = 0u;
    }
    for (uint i = self; i < kAssignScanBlock; i += kAssignScanGroup) {
        counts[i] = first + i < frame.cluster_count ? cursors[first + i] : 0u;
    }
    barrier();
    uint sum = 0u;
    for (uint i = 0u; i < kAssignScanEach; ++i) {
        sum += counts[self * kAssignScanEach + i];
    }
    uint total;
    uint offset = block_sums[gl_WorkGroupID.x] + scanGroup(sum, total);
    uint short_at = 0u;
    uint long_at = 0u;
    uint short_own = 0u;
    uint long_own = 0u;
    for (uint i = 0u; i < kAssignScanEach; ++i) {
        uint count = counts[self * kAssignScanEach + i];
        short_own += count > 0u && count <= kAssignShortList ? 1u : 0u;
        long_own += count > kAssignShortList ? 1u : 0u;
    }
    short_at = short_own > 0u ? atomicAdd(short_total, short_own) : 0u;
    long_at = long_own > 0u ? atomicAdd(long_total, long_own) : 0u;
    barrier();
    if (self == 0u) {
        reserveQueue();
    }
    barrier();
    short_at += short_base;
    long_at += long_base;
    for (uint i = 0u; i < kAssignScanEach; ++i) {
        uint cluster = first + self * kAssignScanEach + i;
        uint count = counts[self * kAssignScanEach + i];
        if (cluster < frame.cluster_count) {
            lists[cluster] = ClusterList(offset, count);
            cursors[cluster] = offset;
        }
        if (count > kAssignShortList) {
            queue[frame.cluster_count - 1u - long_at++] = cluster;
        } else if (count > 0u) {
            queue[short_at++] = cluster;
        }
        offset += count;
    }
}

// Light assignment, fourth pass: adds up the blocks before its own, gives every cluster its run in
// the light index list, and notes which runs are to be put in order.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "lib/assign.glsl"

layout(local_size_x = 256) in;
#include "lib/group_scan.glsl"

shared uint counts[kAssignScanBlock];
shared uint short_total;
shared uint long_total;
shared uint short_base;
shared uint long_base;
shared float pair_sums[kAssignScanGroup];

// The entries of the blocks before this one, and of all; both saturate.
uint blockOffset(out uint entry_count) {
    uint block_count = (frame.cluster_count + kAssignScanBlock - 1u) / kAssignScanBlock;
    uint before = 0u;
    uint all = 0u;
    for (uint i = gl_LocalInvocationIndex; i < block_count; i += kAssignScanGroup) {
        uint sum = block_sums[i];
        all = saturated(all + sum);
        before = saturated(before + (i < gl_WorkGroupID.x ? sum : 0u));
    }
    uint offset;
    scanGroup(all, entry_count);
    scanGroup(before, offset);
    return offset;
}

// Pairs that pixels may evaluate where each loops over its tile's longest list. All must call.
float listedPairs() {
    uint self = gl_LocalInvocationIndex;
    float sum = 0.0;
    for (uint tile = self; tile < frame.grid_x * frame.grid_y; tile += kAssignScanGroup) {
        uint left = tile % frame.grid_x * frame.tile_width_px;
        uint top = tile / frame.grid_x * frame.tile_height_px;
        uint width = min(frame.tile_width_px, max(frame.image_width_px, left) - left);
        uint height = min(frame.tile_height_px, max(frame.image_height_px, top) - top);
        sum += float(width * height) * float(tile_longest[tile]);
    }
    pair_sums[self] = sum;
    for (uint half_size = kAssignScanGroup / 2u; half_size > 0u; half_size /= 2u) {
        barrier();
        if (self < half_size) {
            pair_sums[self] += pair_sums[self + half_size];
        }
    }
    barrier();
    return pair_sums[0];
}

uint outcomeOf(uint entry_count) {
    if (totals.task_count > frame.task_capacity) {
        return kAssignShort;
    }
    bool all_lights = entry_count > frame.max_entries;
    if (frame.max_pairs > 0.0) {
        float pixels = float(frame.image_width_px) * float(frame.image_height_px);
        float pairs = all_lights ? pixels * float(frame.light_count) : listedPairs();
        uint longest = all_lights ? frame.light_count : totals.largest;
        if (pairs > frame.max_pairs || longest > frame.max_list) {
            return kAssignLong;
        }
    }
    if (all_lights) {
        return kAssignAllLights;
    }
    return entry_count > frame.index_capacity ? kAssignShort : kAssignLists;
}

// Without lists of its own each cluster has the one of all lights, or none.
void placeSame(uint count) {
    for (uint i = 0u; i < kAssignScanEach; ++i) {
        uint cluster =
            gl_WorkGroupID.x * kAssignScanBlock + i * kAssignScanGroup + gl_LocalInvocationIndex;
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

void placeLists(uint block_offset) {
    uint self = gl_LocalInvocationIndex;
    uint first = gl_WorkGroupID.x * kAssignScanBlock;
    for (uint i = self; i < kAssignScanBlock; i += kAssignScanGroup) {
        counts[i] = first + i < frame.cluster_count ? cursors[first + i] : 0u;
    }
    if (self == 0u) {
        short_total = 0u;
        long_total = 0u;
    }
    barrier();
    uint sum = 0u;
    uint short_own = 0u;
    uint long_own = 0u;
    for (uint i = 0u; i < kAssignScanEach; ++i) {
        uint count = counts[self * kAssignScanEach + i];
        sum += count;
        short_own += count > 0u && count <= kAssignShortList ? 1u : 0u;
        long_own += count > kAssignShortList ? 1u : 0u;
    }
    uint total;
    uint offset = block_offset + scanGroup(sum, total);
    uint short_at = short_own > 0u ? atomicAdd(short_total, short_own) : 0u;
    uint long_at = long_own > 0u ? atomicAdd(long_total, long_own) : 0u;
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

void main() {
    uint entry_count;
    uint offset = blockOffset(entry_count);
    uint outcome = outcomeOf(entry_count);
    if (gl_WorkGroupID.x == 0u && gl_LocalInvocationIndex == 0u) {
        totals.entry_count = entry_count;
        totals.outcome = outcome;
    }
    if (outcome == kAssignLists) {
        placeLists(offset);
    } else {
        placeSame(outcome == kAssignAllLights ? frame.light_count : 0u);
    }
}

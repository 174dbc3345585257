// Light assignment, fourth pass, one workgroup: where each block's lists begin, and whether all
// lists fit.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "lib/assign.glsl"
#include "lib/assign_scan.glsl"

layout(local_size_x = 256) in;

void main() {
    uint self = gl_LocalInvocationIndex;
    uint block_count = (frame.cluster_count + kAssignScanBlock - 1u) / kAssignScanBlock;
    uint base = 0u;
    for (uint first = 0u; first < block_count; first += kAssignScanGroup) {
        uint block = first + self;
        uint total;
        uint before = scanGroup(block < block_count ? block_sums[block] : 0u, total);
        if (block < block_count) {
            block_sums[block] = saturated(base + before);
        }
        base = saturated(base + total);
    }
    if (self == 0u) {
        totals.entry_count = base;
        if (totals.task_count > frame.task_capacity) {
            totals.outcome = kAssignShort;
        } else if (base > frame.max_entries) {
            totals.outcome = kAssignAllLights;
        } else {
            totals.outcome = base > frame.index_capacity ? kAssignShort : kAssignLists;
        }
    }
}

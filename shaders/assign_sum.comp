// Light assignment, third pass: adds up the counts of each block of clusters, for the scan, and
// keeps the statistics of list lengths.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "lib/assign.glsl"

layout(local_size_x = 256) in;

shared uint block_sum;
shared uint block_largest;
shared uint buckets[kHistogramBuckets];

void main() {
    uint self = gl_LocalInvocationIndex;
    if (self == 0u) {
        block_sum = 0u;
        block_largest = 0u;
    }
    for (uint i = self; i < kHistogramBuckets; i += kAssignScanGroup) {
        buckets[i] = 0u;
    }
    barrier();
    uint sum = 0u; // a block of 2048 lists of 2^20 lights stays below 2^32
    uint largest = 0u;
    uint empty = 0u;
    for (uint i = 0u; i < kAssignScanEach; ++i) {
        uint cluster = gl_WorkGroupID.x * kAssignScanBlock + i * kAssignScanGroup + self;
        if (cluster < frame.cluster_count) {
            uint count = cursors[cluster];
            sum += count;
            largest = max(largest, count);
            if (frame.max_pairs > 0.0 && count > 0u) {
                atomicMax(tile_longest[cluster % (frame.grid_x * frame.grid_y)], count);
            }
            if (count > 0u) {
                atomicAdd(buckets[histogramBucket(count)], 1u);
            } else {
                ++empty;
            }
        }
    }
    atomicAdd(block_sum, sum);
    atomicMax(block_largest, largest);
    atomicAdd(buckets[0], empty);
    barrier();
    for (uint i = self; i < kHistogramBuckets; i += kAssignScanGroup) {
        if (buckets[i] > 0u) {
            atomicAdd(totals.histogram[i], buckets[i]);
        }
    }
    if (self == 0u) {
        block_sums[gl_WorkGroupID.x] = min(block_sum, kScanSaturated);
        atomicMax(totals.largest, block_largest);
    }
}

// Light assignment, last pass for long lists, one workgroup a list: sets a bit for each index in a
// window of a bitmap and reads the bits back in order. Linear in the list, for each window of
// lights.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "lib/assign.glsl"

layout(local_size_x = 256) in;
#include "lib/group_scan.glsl"

shared uint bitmap[kAssignWindowWords];

// Writes the window's indices from `offset` on; returns where the next window's go.
uint writeWindow(uint first_light, uint offset, uint word_count) {
    uint each = (word_count + kAssignScanGroup - 1u) / kAssignScanGroup;
    uint first = gl_LocalInvocationIndex * each;
    uint end = min(first + each, word_count);
    uint sum = 0u;
    for (uint word = first; word < end; ++word) {
        sum += uint(bitCount(bitmap[word]));
    }
    uint total;
    uint at = offset + scanGroup(sum, total);
    for (uint word = first; word < end; ++word) {
        uint bits = bitmap[word];
        while (bits != 0u) {
            indices[at++] = first_light + word * 32u + uint(findLSB(bits));
            bits &= bits - 1u;
        }
    }
    return offset + total;
}

void main() {
    uint self = gl_LocalInvocationIndex;
    for (uint i = gl_WorkGroupID.x; i < totals.long_count; i += gl_NumWorkGroups.x) {
        ClusterList list = lists[queue[frame.cluster_count - 1u - i]];
        uint offset = list.offset;
        for (uint first = 0u; first < frame.light_count; first += kAssignWindowWords * 32u) {
            uint word_count = min((frame.light_count - first + 31u) / 32u, kAssignWindowWords);
            barrier();
            for (uint word = self; word < word_count; word += kAssignScanGroup) {
                bitmap[word] = 0u;
            }
            barrier();
            for (uint k = self; k < list.count; k += kAssignScanGroup) {
                uint bit = raw_indices[list.offset + k] - first; // wraps below the window
                if (bit < word_count * 32u) {
                    atomicOr(bitmap[bit / 32u], 1u << (bit % 32u));
                }
            }
            barrier();
            offset = writeWindow(first, offset, word_count);
        }
    }
}

// Light assignment, fifth pass: puts each light into the lists of its spans, in any order.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "lib/assign.glsl"

layout(local_size_x = 64) in;

void main() {
    uint stride = gl_NumWorkGroups.x * kAssignGroup;
    if (totals.outcome == kAssignAllLights) {
        for (uint i = gl_GlobalInvocationID.x; i < frame.light_count; i += stride) {
            indices[i] = i;
        }
    }
    if (totals.outcome != kAssignLists) {
        return;
    }
    uint line_count = totals.task_count * kAssignTaskLines;
    for (uint i = gl_GlobalInvocationID.x; i < line_count; i += stride) {
        uint span = spans[i];
        if (span != 0u) {
            AssignTask task = tasks[i / kAssignTaskLines];
            uint line = task.line + i % kAssignTaskLines;
            uint rows = (task.corner >> 16u) + 1u;
            uint slice = (task.corner & 0x1ffu) + line / rows;
            uint row = (task.corner >> 9u & 0x7fu) + line % rows;
            uint base = (slice * frame.grid_y + row) * frame.grid_x;
            for (uint x = span & 0xffu; x < span >> 8u; ++x) {
                raw_indices[atomicAdd(cursors[base + x], 1u)] = task.light;
            }
        }
    }
}

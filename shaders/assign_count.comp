// Light assignment, second pass, one invocation a line of a task: finds the columns that the light
// meets, keeps them as a span and counts the light in their clusters.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "lib/assign.glsl"
#include "lib/assign_line.glsl"

layout(local_size_x = 64) in;

void main() {
    uint line_count = min(totals.task_count, frame.task_capacity) * kAssignTaskLines;
    for (uint i = gl_GlobalInvocationID.x; i < line_count; i += gl_NumWorkGroups.x * kAssignGroup) {
        AssignTask task = tasks[i / kAssignTaskLines];
        uint line = task.line + i % kAssignTaskLines;
        uint span = 0u;
        if (line < task.end) {
            uint rows = (task.corner >> 16u) + 1u;
            uint slice = (task.corner & 0x1ffu) + line / rows;
            uint row = (task.corner >> 9u & 0x7fu) + line % rows;
            Columns columns = columnsOf(loadVolume(task.light), slice, row);
            if (columns.first <= columns.last) {
                span = uint(columns.first) | uint(columns.last + 1) << 8u;
                uint base = (slice * frame.grid_y + row) * frame.grid_x;
                for (int x = columns.first; x <= columns.last; ++x) {
                    atomicAdd(cursors[base + uint(x)], 1u);
                }
            }
        }
        spans[i] = span;
    }
}

// Light assignment, first pass, one invocation a light: the rectangle of slices and rows that its
// ball may meet, cut into tasks. A light outside the view leaves none.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "lib/assign.glsl"
#include "lib/assign_line.glsl"

layout(local_size_x = 64) in;

// Rows are bounded by the same numbers as a line's; this much of a tile covers their rounding.
const double kRowMargin = 0.01LF;
const uint kOwnTasks = 4u; // more than these are written by the whole workgroup

shared uint task_total;
shared uint task_base;
shared bool any_large;
shared AssignTask large[kAssignGroup];
shared uvec2 large_tasks[kAssignGroup]; // first, count

// How many planes but the first and the last are not beyond `depth`.
uint sliceOf(double depth) {
    uint low = 1u;
    uint high = frame.grid_z;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (planeDepth(middle) <= depth) {
            low = middle + 1u;
        } else {
            high = middle;
        }
    }
    return low - 1u;
}

struct Rectangle {
    uint first_slice;
    uint last_slice;
    uint first_row;
    uint row_count; // 0: none
};

void boundRows(Interval y, inout Rectangle r) {
    double low = tileAt(frame.rows, y.low) - kRowMargin;
    double high = tileAt(frame.rows, y.high) + kRowMargin;
    if (!meetsAxis(low, high, frame.rows.end)) {
        r.row_count = 0u;
        return;
    }
    r.first_row = uint(tileClamped(low, frame.rows.last_tile));
    r.row_count = uint(tileClamped(high, frame.rows.last_tile)) - r.first_row + 1u;
}

Rectangle rectangleOf(LightVolume volume) {
    Ball ball = volume.ball;
    Rectangle r = Rectangle(0u, frame.grid_z - 1u, 0u, frame.used_rows);
    if (volume.unlimited) {
        return r;
    }
    precise double nearest = ball.z - ball.radius;
    precise double farthest = ball.z + ball.radius;
    if (!(farthest >= 0.0 && nearest <= planeDepth(frame.grid_z))) {
        r.row_count = 0u;
        return r;
    }
    r.first_slice = sliceOf(nearest);
    r.last_slice = sliceOf(farthest);
    if (frame.perspective == 0u) {
        // Lines decide for themselves: only the bounds need be safe from rounding.
        r.first_slice -= min(r.first_slice, 1u);
        r.last_slice = min(r.last_slice + 1u, frame.grid_z - 1u);
        boundRows(Interval(ball.y - ball.radius, ball.y + ball.radius), r);
        return r;
    }
    if (outsidePicture(ball, frame.columns, frame.rows)) {
        r.row_count = 0u;
        return r;
    }
    Touches y_touches = touchCircle(ball.y, ball.z, ball.radius);
    Interval y = rowsBetween(ball, y_touches, r.first_slice, r.last_slice + 1u);
    if (r.first_slice == 0u) {
        y = joined(y, rowsBetween(ball, y_touches, 0u, 1u));
    }
    boundRows(y, r);
    return r;
}

void storeTask(AssignTask task, uint base, uint i) {
    if (base + i < frame.task_capacity) {
        task.line = i * kAssignTaskLines;
        tasks[base + i] = task;
    }
}

void main() {
    uint self = gl_LocalInvocationIndex;
    uint light = gl_GlobalInvocationID.x;
    if (self == 0u) {
        task_total = 0u;
        any_large = false;
    }
    barrier();
    AssignTask task = AssignTask(light, 0u, 0u, 0u);
    if (light < frame.light_count) {
        Rectangle r = rectangleOf(loadVolume(light));
        if (r.row_count > 0u) {
            task.corner = r.first_slice | r.first_row << 9u | (r.row_count - 1u) << 16u;
            task.end = (r.last_slice - r.first_slice + 1u) * r.row_count;
        }
    }
    uint count = (task.end + kAssignTaskLines - 1u) / kAssignTaskLines;
    uint first = count > 0u ? atomicAdd(task_total, count) : 0u;
    large[self] = task;
    large_tasks[self] = uvec2(first, count);
    if (count > kOwnTasks) {
        any_large = true;
    }
    barrier();
    if (self == 0u && task_total > 0u) {
        task_base = atomicAdd(totals.task_count, task_total);
        uint groups = (min(task_base + task_total, frame.task_capacity) * kAssignTaskLines +
                       kAssignGroup - 1u) /
                      kAssignGroup;
        atomicMax(totals.tasks.x, min(groups, kAssignMaxGroups));
    }
    barrier();
    for (uint i = 0u; i < min(count, kOwnTasks); ++i) {
        storeTask(task, task_base + first, i);
    }
    if (any_large) {
        for (uint other = 0u; other < kAssignGroup; ++other) {
            for (uint i = kOwnTasks + self; i < large_tasks[other].y; i += kAssignGroup) {
                storeTask(large[other], task_base + large_tasks[other].x, i);
            }
        }
    }
}

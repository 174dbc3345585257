// Draw commands of the visible meshlets, in the frame's order, packed group by group.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#define FROXEL_CAMERA_ALONE
#include "lib/frame.glsl"
#include "lib/visibility_set.glsl"
#include "lib/visibility_draws.glsl"

layout(local_size_x = kCullGroup) in;

shared uint partial[kCullGroup];

// Visible meshlets of the group's workgroups before this one.
uint countBefore(uint first_block, uint lane) {
    uint sum = 0;
    for (uint block = first_block + lane; block < gl_WorkGroupID.x; block += kCullGroup) {
        sum += counts[group_count + block];
    }
    partial[lane] = sum;
    barrier();
    for (uint step = kCullGroup / 2; step > 0; step /= 2) {
        if (lane < step) {
            partial[lane] += partial[lane + step];
        }
        barrier();
    }
    return partial[0];
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    uint lane = gl_LocalInvocationIndex;
    uint placed = placedAt(i);
    PlacedMeshlet m = placed_meshlets[placed];
    VisibleItem item = items[m.item];
    MeshletGroup group = groups[item.draw_group];
    uint before = countBefore(group.first_block, lane);
    uint rank = ranks[i];
    if (rank != kCulled) {
        DrawCommand draw = DrawCommand(meshlets[m.meshlet].index_count, 1u, m.first_index,
                                       item.vertex_offset, placed);
        commands[group.first_block * kCullGroup + before + rank] = draw;
    }
    if (lane == 0 && gl_WorkGroupID.x + 1 == group.first_block + group.block_count) {
        counts[item.draw_group] = before + counts[group_count + gl_WorkGroupID.x];
    }
}

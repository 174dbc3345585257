// The draws that culling writes. ranks: of each placed meshlet in its workgroup, kCulled where it
// is out of sight; counts: of each group's draws, then of each workgroup's visible meshlets; order:
// of the placed meshlets, near ones of a group first; without it they are taken as they stand.
layout(set = 2, binding = 9, scalar) buffer CommandBlock { DrawCommand commands[]; };
layout(set = 2, binding = 10, scalar) buffer RankBlock { uint ranks[]; };
layout(set = 2, binding = 11, scalar) buffer CountBlock { uint counts[]; };
layout(set = 2, binding = 12, scalar) readonly buffer OrderBlock { uint order[]; };

layout(push_constant) uniform CullBlock {
    uint cull_flags; // kKeepAll, kOrdered
    uint group_count;
};

// The placed meshlet at a place of the order.
uint placedAt(uint i) { return (cull_flags & kOrdered) != 0u ? order[i] : i; }

// The draws that culling writes. ranks: of each placed meshlet in its workgroup, kCulled where it is
// out of sight; block_counts: visible meshlets of each workgroup.
layout(set = 2, binding = 9, scalar) buffer CommandBlock { DrawCommand commands[]; };
layout(set = 2, binding = 10, scalar) buffer RankBlock { uint ranks[]; };
layout(set = 2, binding = 11, scalar) buffer CountBlock { uint block_counts[]; };
layout(set = 2, binding = 12, scalar) buffer DrawCountBlock { uint draw_counts[]; };

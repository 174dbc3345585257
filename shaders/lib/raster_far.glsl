// The farthest depth that was drawn so far in each block of pixels: what lies behind all of a
// block's pixels wins none of them. Two sizes of blocks, row by row, the finer ones first.
layout(set = 2, binding = 24, scalar) buffer FarBlock { float far_depths[]; };

uvec2 blocksOf(uint side) {
    return (uvec2(frame.camera.width_px, frame.camera.height_px) + side - 1u) / side;
}

uint coarseBlocksBegin() {
    uvec2 fine = blocksOf(kFarFine);
    return fine.x * fine.y;
}

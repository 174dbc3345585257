// Morton order inside the 8 x 8 block: eight consecutive invocations are 4 x 2 pixels, 32 are 8
// x 4.
uvec2 pixelInGroup(uint i) {
    return uvec2((i & 1u) | ((i >> 1) & 2u) | ((i >> 2) & 4u),
                 ((i >> 1) & 1u) | ((i >> 2) & 2u) | ((i >> 3) & 4u));
}

// Writes a pixel of a triangle, where it is the nearest so far and its material does not mask it.
layout(push_constant) uniform RasterBlock {
    uint only_material; // kAnyMaterial, or the masked one whose textures are bound
    uint takes_opaque;
};

bool isMasked(VisibleItem item) {
    return (MATERIAL_FLAGS & kMaterialMask) != 0 && (item.flags & kMaterialMask) != 0;
}

// Whether this dispatch draws an item.
bool drawsItem(VisibleItem item) {
    return isMasked(item) ? only_material == kAnyMaterial || only_material == item.material_index
                          : takes_opaque != 0;
}

void drawPixel(uvec2 pixel, float depth, uint id, bool masked) {
    uint at = pixel.y * frame.width_px + pixel.x;
    uint bits = floatBitsToUint(depth);
    // Depths only grow, so a stale one is no harm. Not the whole word: its halves may be of two.
    if (!(depth > 0.0) || uint(words[at] >> 32) > bits) {
        return;
    }
    if (masked) {
        bool front;
        VertexData v = fetchSurface(id, pixel, front);
        if (maskedOut(baseColor(v))) {
            return;
        }
    }
    atomicMax(words[at], (uint64_t(bits) << 32) | uint64_t(id));
}

// Writes a pixel of a triangle, where it is the nearest so far and its material does not mask it.
#include "lib/raster_push.glsl"

// Masked materials have pipelines of their own: others need a fraction of the registers.
const bool kMasked = (MATERIAL_FLAGS & kMaterialMask) != 0;

// Whether this dispatch draws an item.
bool drawsItem(VisibleItem item) {
    bool masked = (item.flags & kMaterialMask) != 0;
    return masked == kMasked &&
           (!masked || only_material == kAnyMaterial || only_material == item.material_index);
}

void drawPixel(uvec2 pixel, float depth, uint id) {
    uint at = pixel.y * frame.camera.width_px + pixel.x;
    uint bits = floatBitsToUint(depth);
    if (!(depth > 0.0)) {
        return;
    }
    if (kMasked) { // a look spares the textures; without them it costs more than an atomic
        // Depths only grow, so a stale one is no harm. Not the whole word: its halves may be of
        // two.
        if (uint(words[at] >> 32) > bits) {
            return;
        }
        bool front;
        VertexData v = fetchSurface(fetchTriangle(id), pixel, front);
        if (maskedOut(baseColor(v))) {
            return;
        }
    }
    atomicMax(words[at], (uint64_t(bits) << 32) | uint64_t(id));
}

// Writes a triangle's pixels, where it is the nearest so far and its material does not mask it;
// with FROXEL_PEELED where it is one of the nearest layers.
#include "lib/raster_push.glsl"

// Masked materials have pipelines of their own: others need a fraction of the registers.
const bool kMasked = (MATERIAL_FLAGS & kMaterialMask) != 0;

// Whether this dispatch draws an item.
bool drawsItem(VisibleItem item) {
    bool masked = (item.flags & kMaterialMask) != 0;
    return masked == kMasked &&
           (!masked || only_material == kAnyMaterial || only_material == item.material_index);
}

uint placeOf(uvec2 pixel) { return pixel.y * frame.camera.width_px + pixel.x; }

#ifdef FROXEL_PEELED
// Pixels that an invocation keeps at a time: each waits for what its word was before.
const uint kBurst = 4u;

uint pixelCount() { return frame.camera.width_px * frame.camera.height_px; }
uint lastPlaceOf(uvec2 pixel) { return placeOf(pixel) + (layerCount() - 1u) * pixelCount(); }

// A nearer layer takes the place of a farther one, which goes on to the next: whatever the order of
// the triangles, the nearest remain (Liu et al. 2010, "FreePipe", multi-depth peeling). Triangles
// at the same depth are one layer. Pixels are `apart` from each other; a word of 0 is none.
void keepWords(uvec2 pixel, uint apart, uint64_t burst[kBurst]) {
    uint at = placeOf(pixel);
    bool left = true;
    for (uint layer = 0; layer < layerCount() && left; ++layer) {
        uint64_t before[kBurst];
        [[unroll]] for (uint k = 0; k < kBurst; ++k) {
            before[k] = 0;
            if (burst[k] != 0) {
                before[k] = atomicMax(words[at + k * apart], burst[k]);
            }
        }
        left = false;
        [[unroll]] for (uint k = 0; k < kBurst; ++k) {
            bool same = before[k] >> 32 == burst[k] >> 32;
            burst[k] = same ? uint64_t(0) : min(before[k], burst[k]);
            left = left || burst[k] != 0;
        }
        at += pixelCount();
    }
}
#else
const uint kBurst = 1u;

uint lastPlaceOf(uvec2 pixel) { return placeOf(pixel); }

void keepWords(uvec2 pixel, uint apart, uint64_t burst[kBurst]) {
    if (burst[0] != 0) {
        atomicMax(words[placeOf(pixel)], burst[0]);
    }
}
#endif

// Of a triangle at a pixel; 0: there is nothing of it.
uint64_t wordAt(uvec2 pixel, float depth, uint id) {
    uint bits = floatBitsToUint(depth);
    if (!(depth > 0.0)) {
        return 0;
    }
    if (kMasked) { // a look spares the textures; without them it costs more than an atomic
        // Depths only grow, so a stale one is no harm. Not the whole word: its halves may be of
        // two.
        if (uint(words[lastPlaceOf(pixel)] >> 32) > bits) {
            return 0;
        }
        bool front;
        VertexData v = fetchSurface(fetchTriangle(id), pixel, front);
        if (maskedOut(baseColor(v))) {
            return 0;
        }
    }
    return (uint64_t(bits) << 32) | uint64_t(id);
}

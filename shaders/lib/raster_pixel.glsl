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

uint64_t wordOf(uint depth_bits, uint id) { return (uint64_t(depth_bits) << 32) | uint64_t(id); }

// Whether the triangle's material shows it there. place: of the word that it must outdo.
bool isShown(uvec2 pixel, uint place, uint depth_bits, uint id) {
    if (kMasked) { // a look spares the textures; without them it costs more than an atomic
        // Depths only grow, so a stale one is no harm. Not the whole word: its halves may be of
        // two.
        if (uint(words[place] >> 32) > depth_bits) {
            return false;
        }
        bool front;
        VertexData v = fetchSurface(fetchTriangle(id), pixel, front);
        return !maskedOut(baseColor(v));
    }
    return true;
}

#ifdef FROXEL_PEELED
// Pixels that an invocation keeps at a time: each waits for what its word was before.
const uint kBurst = 4u;

uint pixelCount() { return frame.camera.width_px * frame.camera.height_px; }

// Of a triangle at a pixel; 0: there is nothing of it.
uint64_t wordAt(uvec2 pixel, float depth, uint id) {
    uint bits = floatBitsToUint(depth);
    uint last = placeOf(pixel) + (layerCount() - 1u) * pixelCount();
    return depth > 0.0 && isShown(pixel, last, bits, id) ? wordOf(bits, id) : uint64_t(0);
}

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
void drawPixel(uvec2 pixel, float depth, uint id) {
    uint at = placeOf(pixel);
    uint bits = floatBitsToUint(depth);
    if (depth > 0.0 && isShown(pixel, at, bits, id)) {
        atomicMax(words[at], wordOf(bits, id));
    }
}
#endif

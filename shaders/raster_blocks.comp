// Rasters large triangles and those that need clipping, in blocks of their boxes, which workgroups
// take in turns.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
#extension GL_EXT_control_flow_attributes : require

#extension GL_GOOGLE_include_directive : require
#ifdef FROXEL_BINDLESS
#extension GL_EXT_nonuniform_qualifier : require
#endif
#define FROXEL_CAMERA_ALONE
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/visibility_set.glsl"
#include "lib/raster_set.glsl"
#include "lib/material.glsl"
#include "lib/visibility_surface.glsl"
#include "lib/raster_triangle.glsl"
#include "lib/raster_clip.glsl"
#include "lib/raster_pixel.glsl"

layout(local_size_x = kRasterBlockGroup) in;

// Blocks that a workgroup takes at a time: of several layers each takes longer, and there are few.
#ifdef FROXEL_PEELED
const uint kRun = 1u;
#else
const uint kRun = kRasterRun;
#endif

const uint kLaneSide = 8u; // a workgroup's pixels at a time

// The last triangle whose blocks begin at or before `block`.
uint triangleOfBlock(uint64_t block, uint count) {
    uint first = 0;
    while (count > 1u) {
        uint half_count = count / 2u;
        bool later = large_triangles[first + half_count].first_block <= block;
        first += later ? half_count : 0u;
        count = later ? count - half_count : half_count;
    }
    return first;
}

// An invocation's of a row of a block, whose first pixel is `first`; lane: in the block.
#ifdef FROXEL_PEELED
void drawPixels(Edges edges, uvec2 first, uvec2 lane, uvec2 size, uint id) {
    uint64_t burst[kBurst];
    [[unroll]] for (uint k = 0; k < kBurst; ++k) {
        uvec2 at = lane + uvec2(k * kLaneSide, 0);
        ivec3 inside = edges.inside + edges.step_x * int(at.x) + edges.step_y * int(at.y);
        burst[k] = 0;
        if (isInside(inside) && all(lessThan(first + at, size))) {
            burst[k] = wordAt(first + at, depthAt(inside, edges.rest, edges.scale), id);
        }
    }
    keepWords(first + lane, kLaneSide, burst);
}
#else
void drawPixels(Edges edges, uvec2 first, uvec2 lane, uvec2 size, uint id) {
    for (uint x = 0; x < kRasterBlock; x += kLaneSide) {
        uvec2 at = lane + uvec2(x, 0);
        ivec3 inside = edges.inside + edges.step_x * int(at.x) + edges.step_y * int(at.y);
        if (isInside(inside) && all(lessThan(first + at, size))) {
            drawPixel(first + at, depthAt(inside, edges.rest, edges.scale), id);
        }
    }
}
#endif

void drawBlock(Corner a, Corner b, Corner c, bool mirrored, VisibleItem item, uint id,
               uvec2 first) {
    bool both_sides = (item.flags & kMaterialDoubleSided) != 0;
    int64_t area = doubleArea(a, b, c);
    if (!showsFace(area, mirrored, both_sides)) {
        return;
    }
    Edges edges = edgesAt(ivec2(first), a, b, c, area);
    // Each edge where it is highest in the block.
    const int kLast = int(kRasterBlock) - 1;
    if (!isInside(edges.inside + kLast * (max(edges.step_x, 0) + max(edges.step_y, 0)))) {
        return;
    }
    uvec2 size = uvec2(frame.camera.width_px, frame.camera.height_px);
    uvec2 lane = uvec2(gl_LocalInvocationIndex % kLaneSide, gl_LocalInvocationIndex / kLaneSide);
    for (uint y = 0; y < kRasterBlock; y += kLaneSide) {
        drawPixels(edges, first, lane + uvec2(0, y), size, id);
    }
}

void drawClipped(ClipTriangle t, bool mirrored, VisibleItem item, uint id, uvec2 first) {
    vec4 corners[kMostCorners];
    corners[0] = t.a;
    corners[1] = t.b;
    corners[2] = t.c;
    uint count = clipCorners(corners, 3u);
    for (uint i = 2; i < count; ++i) {
        drawBlock(toScreen(corners[0]), toScreen(corners[i - 1u]), toScreen(corners[i]), mirrored,
                  item, id, first);
    }
}

void drawLarge(LargeTriangle large, uint of_box) {
    PlacedMeshlet placed = placed_meshlets[large.id >> kTriangleBits];
    VisibleItem item = items[placed.item];
    if (!drawsItem(item)) {
        return;
    }
    uint row_blocks = large.box >> 24;
    uvec2 first = uvec2(large.box & 4095u, (large.box >> 12) & 4095u) +
                  uvec2(of_box % row_blocks, of_box / row_blocks) * kRasterBlock;
    InstanceView view = instances[item.instance];
    ClipTriangle t = clipTriangle(placed, item, view, large.id & ((1u << kTriangleBits) - 1u));
    if (drawable(t.a) && drawable(t.b) && drawable(t.c)) {
        drawBlock(toScreen(t.a), toScreen(t.b), toScreen(t.c), view.mirrored != 0u, item, large.id,
                  first);
    } else {
        drawClipped(t, view.mirrored != 0u, item, large.id, first);
    }
}

void main() {
    uint triangle_count = uint(batches[batch].large >> int(kRasterBlockBits));
    uint64_t block_count = batches[batch].large & ((uint64_t(1) << int(kRasterBlockBits)) - 1);
    uint64_t run = uint64_t(gl_WorkGroupID.x) * kRun;
    for (; run < block_count; run += gl_NumWorkGroups.x * kRun) {
        uint i = triangleOfBlock(run, triangle_count);
        for (uint64_t block = run; block < min(run + kRun, block_count); ++block) {
            if (i + 1u < triangle_count && large_triangles[i + 1u].first_block <= block) {
                ++i;
            }
            drawLarge(large_triangles[i], uint(block - large_triangles[i].first_block));
        }
    }
}

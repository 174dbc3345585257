// Rasters the triangles of visible meshlets, a workgroup a meshlet: an invocation projects a vertex
// and sets up a triangle, then the rows of all small ones are shared out. Large ones are left to
// raster_blocks.comp.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
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
#ifdef FROXEL_BATCHES
#include "lib/raster_hidden.glsl"
#endif

layout(local_size_x = kRasterGroup) in;

struct SmallTriangle {
    Edges edges;
    uvec2 first; // pixel of the box
    uint width;
};

shared Corner corners[kMeshletVertices];
shared bool corners_drawable[kMeshletVertices];
shared SmallTriangle small[kRasterGroup];
shared uint rows_until[kRasterGroup]; // of this triangle and those before it

// For the second pass; low and high are the first and last pixel of the triangle's box.
void leaveToBlocks(uint id, ivec2 low, ivec2 high) {
    uvec2 blocks = (uvec2(high - low) + kRasterBlock) / kRasterBlock;
    uint64_t count = uint64_t(blocks.x * blocks.y);
    uint64_t before =
        atomicAdd(batches[batch].large, (uint64_t(1) << int(kRasterBlockBits)) | count);
    uint64_t first_block = before & ((uint64_t(1) << int(kRasterBlockBits)) - 1);
    uint box = uint(low.x) | (uint(low.y) << 12) | (blocks.x << 24);
    large_triangles[uint(before >> int(kRasterBlockBits))] = LargeTriangle(first_block, id, box);
}

void addToBox(vec4 clip, inout vec2 low, inout vec2 high) {
    vec2 ndc = clamp(clip.xy / clip.w, vec2(-4.0), vec2(4.0));
    low = min(low, ndc);
    high = max(high, ndc);
}

void addEdgeToBox(vec4 a, vec4 b, inout vec2 low, inout vec2 high) {
    if (inFront(a)) {
        addToBox(a, low, high);
    }
    if (inFront(a) != inFront(b)) {
        addToBox(inFront(a) ? cutEdge(a, b, kNearPlane) : cutEdge(b, a, kNearPlane), low, high);
    }
}

// Of what is left after clipping, a pixel too large on each side.
void boxOfClipped(ClipTriangle t, out ivec2 low, out ivec2 high) {
    vec2 ndc_low = vec2(4.0);
    vec2 ndc_high = vec2(-4.0);
    addEdgeToBox(t.a, t.b, ndc_low, ndc_high);
    addEdgeToBox(t.b, t.c, ndc_low, ndc_high);
    addEdgeToBox(t.c, t.a, ndc_low, ndc_high);
    low = ivec2(floor((ndc_low + 1.0) * halfSize())) - 1;
    high = ivec2(ceil((ndc_high + 1.0) * halfSize())) + 1;
}

// Of the meshlet's vertices, one an invocation.
void projectVertices(Meshlet m, VisibleItem item, InstanceView view, uint lane) {
    if (lane < m.vertex_count) {
        vec4 clip = clipVertex(view, meshlet_words[m.first_word + lane] + item.vertex_offset);
        corners_drawable[lane] = drawable(clip);
        corners[lane] = toScreen(clip);
    }
}

// Sets up the invocation's triangle, of the vertices that the word names; the rows that its
// workgroup draws, 0 where there is nothing or where it is left to the second pass.
uint prepare(PlacedMeshlet placed, VisibleItem item, InstanceView view, uint word, uint id) {
    uint lane = gl_LocalInvocationIndex;
    uvec3 v = uvec3(word, word >> 8, word >> 16) & 0xffu;
    bool whole = corners_drawable[v.x] && corners_drawable[v.y] && corners_drawable[v.z];
    ivec2 low;
    ivec2 high;
    Corner a;
    Corner b;
    Corner c;
    if (whole) {
        a = corners[v.x];
        b = corners[v.y];
        c = corners[v.z];
        const int kHalf = 1 << int(kSubpixelBits - 1u);
        low = (min(min(a.at, b.at), c.at) + (kHalf - 1)) >> int(kSubpixelBits);
        high = (max(max(a.at, b.at), c.at) - kHalf) >> int(kSubpixelBits);
    } else {
        boxOfClipped(clipTriangle(placed, item, view, lane), low, high);
    }
    low = max(low, ivec2(0));
    high = min(high, ivec2(frame.camera.width_px, frame.camera.height_px) - 1);
    if (any(lessThan(high, low))) {
        return 0; // out of sight, or between pixels' centres
    }
    Edges edges;
    bool both_sides = (item.flags & kMaterialDoubleSided) != 0;
    if (whole && !setEdges(a, b, c, view.mirrored != 0u, both_sides, low, edges)) {
        return 0;
    }
    ivec2 size = high - low + 1;
    if (!whole || max(size.x, size.y) > int(kRasterSmall)) {
        leaveToBlocks(id, low, high);
        return 0;
    }
    small[lane] = SmallTriangle(edges, uvec2(low), uint(size.x));
    return uint(size.y);
}

// Pixels of a row that an edge leaves out for sure.
float before(int inside, int step_x) {
    return inside < 0 && step_x > 0 ? float(-inside) / float(step_x) * 0.999999 : 0.0;
}

void drawRow(SmallTriangle t, uint row, uint id) {
    ivec3 inside = t.edges.inside + t.edges.step_y * int(row);
    uint first =
        uint(min(max(max(before(inside.x, t.edges.step_x.x), before(inside.y, t.edges.step_x.y)),
                     before(inside.z, t.edges.step_x.z)),
                 float(kRasterSmall)));
    inside += t.edges.step_x * int(first);
    bool entered = false;
    for (uint x = first; x < t.width; ++x) {
        if (isInside(inside)) {
            entered = true;
            drawPixel(t.first + uvec2(x, row), depthAt(inside, t.edges.rest, t.edges.scale), id);
        } else if (entered) {
            break;
        }
        inside += t.edges.step_x;
    }
}

// The first triangle whose rows end beyond `row`.
uint triangleOfRow(uint row) {
    uint first = 0;
    for (uint step = kRasterGroup / 2; step > 0; step /= 2) {
        first += rows_until[first + step - 1u] <= row ? step : 0u;
    }
    return first;
}

void main() {
    uint meshlet = visible_meshlets[batches[batch].first + gl_WorkGroupID.x];
    PlacedMeshlet placed = placed_meshlets[meshlet];
    VisibleItem item = items[placed.item];
    if (!drawsItem(item)) {
        return;
    }
    Meshlet m = meshlets[placed.meshlet];
    InstanceView view = instances[item.instance];
#ifdef FROXEL_BATCHES
    if (batch > 0u && item.bends == 0u && isHidden(view, m)) {
        return;
    }
#endif
    uint lane = gl_LocalInvocationIndex;
    projectVertices(m, item, view, lane);
    barrier();
    uint first_id = meshlet << kTriangleBits;
    uint rows = 0;
    if (3u * lane < m.index_count) {
        uint word = meshlet_words[m.first_word + m.vertex_count + lane];
        rows = prepare(placed, item, view, word, first_id | lane);
    }
    rows_until[lane] = rows;
    barrier();
    for (uint step = 1; step < kRasterGroup; step *= 2) {
        uint before = lane >= step ? rows_until[lane - step] : 0u;
        barrier();
        rows_until[lane] += before;
        barrier();
    }
    for (uint row = lane; row < rows_until[kRasterGroup - 1u]; row += kRasterGroup) {
        uint i = triangleOfRow(row);
        uint skipped = i > 0 ? rows_until[i - 1u] : 0u;
        drawRow(small[i], row - skipped, first_id | i);
    }
}

// Rasters the triangles of visible meshlets, a workgroup a meshlet. Its invocations take turns to
// project its vertices, to find the triangles that may cover a pixel, to set those up, and to draw
// rows of theirs; one of few pixels is drawn where it is set up. Of meshlets far away most
// triangles lie between pixels' centres. Large ones are left to raster_blocks.comp.
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
#define FROXEL_EDGE_INT int // of triangles no larger than kRasterSmall
#include "lib/raster_triangle.glsl"
#include "lib/raster_clip.glsl"
#include "lib/raster_pixel.glsl"

#ifdef FROXEL_PEELED
const uint kGroup = kPeeledGroup;

#else
const uint kGroup = kRasterGroup;
#endif

layout(local_size_x = kGroup) in;

struct SmallTriangle {
    Edges edges;
    uvec2 first; // pixel of the box
    uint width;
    uint triangle; // of the meshlet
};

// In fewer bits, none of which is lost.
struct PackedTriangle {
    ivec3 inside;
    uvec3 steps; // y above x, 16 bits each
    vec3 scale;
    uint rest_width; // from the lowest: 8 bits of each rest, width
    uint place;      // first.x and first.y, 12 bits each; triangle
};

// Triangles whose rows are shared out together. Shared memory bounds how many workgroups run at a
// time on a multiprocessor, which matters where there are many of them; with few, rounds take time.
#ifdef FROXEL_MANY_MESHLETS
const uint kRound = 32u;
#else
const uint kRound = 128u;
#endif
const uint kRounds = (kMeshletTriangles + kRound - 1u) / kRound;

shared float corner_x[kMeshletVertices]; // onScreen; kNotDrawable of what needs clipping
shared float corner_y[kMeshletVertices];
shared float corner_z[kMeshletVertices];
shared uint covering[kMeshletTriangles]; // its vertices' numbers; above kTriangleShift, its own
shared uint covering_count;
shared PackedTriangle small[min(kRound, kMeshletTriangles)]; // whose rows are shared out
shared uint first_rows[min(kRound, kMeshletTriangles)];      // how many rows those before have
shared uint shared_out[kRounds]; // in each: rows; above kRowBits, their triangles

const float kNotDrawable = 1e9;
const uint kTriangleShift = 24u;
const uint kRowBits = 16u;

PackedTriangle pack(SmallTriangle t) {
    uvec3 rest = uvec3(t.edges.rest * float(1u << kSubpixelBits));
    uvec3 steps = (uvec3(t.edges.step_x) & 0xffffu) | (uvec3(t.edges.step_y) << 16);
    return PackedTriangle(t.edges.inside, steps, t.edges.scale,
                          rest.x | (rest.y << 8) | (rest.z << 16) | (t.width << 24),
                          t.first.x | (t.first.y << 12) | (t.triangle << 24));
}

SmallTriangle unpack(PackedTriangle p) {
    uvec3 rest = uvec3(p.rest_width, p.rest_width >> 8, p.rest_width >> 16) & 0xffu;
    ivec3 steps = ivec3(p.steps);
    Edges edges = Edges(p.inside, (steps << 16) >> 16, steps >> 16,
                        vec3(rest) * (1.0 / float(1u << kSubpixelBits)), p.scale);
    return SmallTriangle(edges, uvec2(p.place, p.place >> 12) & 0xfffu, p.rest_width >> 24,
                         p.place >> 24);
}

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

// Pixels of a row that an edge leaves out for sure.
float before(int inside, int step_x) {
    return inside < 0 && step_x > 0 ? float(-inside) / float(step_x) * 0.999999 : 0.0;
}

// The rest of a row of the triangle's box, from a pixel on; inside: there.
#ifdef FROXEL_PEELED
void drawPixels(SmallTriangle t, uvec2 from, ivec3 inside, uint id) {
    bool entered = false;
    for (uint x = from.x; x < t.width; x += kBurst) {
        uvec2 pixel = t.first + uvec2(x, from.y);
        uint64_t burst[kBurst];
        bool any = false;
        [[unroll]] for (uint k = 0; k < kBurst; ++k) {
            burst[k] = 0;
            if (isInside(inside) && x + k < t.width) {
                any = true;
                burst[k] =
                    wordAt(pixel + uvec2(k, 0), depthAt(inside, t.edges.rest, t.edges.scale), id);
            }
            inside += t.edges.step_x;
        }
        if (any) {
            entered = true;
            keepWords(pixel, 1u, burst);
        } else if (entered) {
            break;
        }
    }
}
#else
void drawPixels(SmallTriangle t, uvec2 from, ivec3 inside, uint id) {
    bool entered = false;
    for (uint x = from.x; x < t.width; ++x) {
        if (isInside(inside)) {
            entered = true;
            drawPixel(t.first + uvec2(x, from.y), depthAt(inside, t.edges.rest, t.edges.scale), id);
        } else if (entered) {
            break;
        }
        inside += t.edges.step_x;
    }
}
#endif

void drawRow(SmallTriangle t, uint row, uint first_id) {
    ivec3 inside = t.edges.inside + t.edges.step_y * int(row);
    uint first =
        uint(min(max(max(before(inside.x, t.edges.step_x.x), before(inside.y, t.edges.step_x.y)),
                     before(inside.z, t.edges.step_x.z)),
                 float(kRasterSmall)));
    inside += t.edges.step_x * int(first);
    drawPixels(t, uvec2(first, row), inside, first_id | t.triangle);
}

void projectVertices(Meshlet m, VisibleItem item, InstanceView view) {
    for (uint i = gl_LocalInvocationIndex; i < m.vertex_count; i += kGroup) {
        vec4 clip = clipVertex(view, meshlet_words[m.first_word + i] + item.vertex_offset);
        vec3 at = onScreen(clip);
        corner_x[i] = drawable(clip) ? at.x : kNotDrawable;
        corner_y[i] = at.y;
        corner_z[i] = at.z;
    }
}

Corner cornerAt(uint i) { return snap(vec3(corner_x[i], corner_y[i], corner_z[i])); }

void drawOrShareOut(SmallTriangle t, uint rows, uint first_id, uint round) {
    if (rows * t.width <= kRasterTiny) {
        for (uint row = 0; row < rows; ++row) {
            drawRow(t, row, first_id);
        }
        return;
    }
    uint before = atomicAdd(shared_out[round], (1u << kRowBits) | rows);
    uint place = before >> kRowBits;
    small[place] = pack(t);
    first_rows[place] = before & ((1u << kRowBits) - 1u);
}

// The first and last pixel whose centre may be inside, of the picture.
struct PixelBox {
    ivec2 low;
    ivec2 high;
};

PixelBox clampToPicture(ivec2 low, ivec2 high) {
    ivec2 last = ivec2(frame.camera.width_px, frame.camera.height_px) - 1;
    return PixelBox(max(low, ivec2(0)), min(high, last));
}

bool isEmpty(PixelBox box) { return any(lessThan(box.high, box.low)); }

PixelBox boxOf(ivec2 low_at, ivec2 high_at) {
    const int kHalf = 1 << int(kSubpixelBits - 1u);
    return clampToPicture((low_at + (kHalf - 1)) >> int(kSubpixelBits),
                          (high_at - kHalf) >> int(kSubpixelBits));
}

uvec3 verticesOf(uint word) { return uvec3(word, word >> 8, word >> 16) & 0xffu; }

void leaveClipped(PlacedMeshlet placed, VisibleItem item, InstanceView view, uint id) {
    ivec2 low;
    ivec2 high;
    boxOfClipped(clipTriangle(placed, item, view, id & ((1u << kTriangleBits) - 1u)), low, high);
    PixelBox box = clampToPicture(low, high);
    if (!isEmpty(box)) {
        leaveToBlocks(id, box.low, box.high);
    }
}

// Keeps a triangle that may cover a pixel, of the vertices that the word names.
void keepCovering(PlacedMeshlet placed, VisibleItem item, InstanceView view, uint word, uint id) {
    uvec3 v = verticesOf(word);
    if (any(equal(vec3(corner_x[v.x], corner_x[v.y], corner_x[v.z]), vec3(kNotDrawable)))) {
        leaveClipped(placed, item, view, id);
        return;
    }
    Corner a = cornerAt(v.x);
    Corner b = cornerAt(v.y);
    Corner c = cornerAt(v.z);
    ivec2 low_at = min(min(a.at, b.at), c.at);
    ivec2 high_at = max(max(a.at, b.at), c.at);
    PixelBox box = boxOf(low_at, high_at);
    bool both_sides = (item.flags & kMaterialDoubleSided) != 0;
    if (isEmpty(box) || !showsFace(doubleArea(a, b, c), view.mirrored != 0u, both_sides)) {
        return;
    }
    if (any(greaterThan(high_at - low_at, ivec2(kRasterSmall << kSubpixelBits)))) {
        leaveToBlocks(id, box.low, box.high);
        return;
    }
    uint triangle = id & ((1u << kTriangleBits) - 1u);
    covering[atomicAdd(covering_count, 1u)] = word | (triangle << kTriangleShift);
}

void setUp(uint word, uint first_id, uint round) {
    uvec3 v = verticesOf(word);
    Corner a = cornerAt(v.x);
    Corner b = cornerAt(v.y);
    Corner c = cornerAt(v.z);
    PixelBox box = boxOf(min(min(a.at, b.at), c.at), max(max(a.at, b.at), c.at));
    Edges edges = edgesAt(box.low, a, b, c, int(doubleArea(a, b, c)));
    uvec2 size = uvec2(box.high - box.low) + 1u;
    drawOrShareOut(SmallTriangle(edges, uvec2(box.low), size.x, word >> kTriangleShift), size.y,
                   first_id, round);
}

// The last triangle whose rows begin at or before `row`.
uint triangleOfRow(uint row, uint count) {
    uint first = 0;
    for (uint step = kRound / 2u; step > 0u; step /= 2u) {
        uint later = first + step;
        first = later < count && first_rows[later] <= row ? later : first;
    }
    return first;
}

void drawRows(uint shared_rows, uint first_id) {
    uint count = shared_rows >> kRowBits;
    uint rows = shared_rows & ((1u << kRowBits) - 1u);
    for (uint row = gl_LocalInvocationIndex; row < rows; row += kGroup) {
        uint i = triangleOfRow(row, count);
        drawRow(unpack(small[i]), row - first_rows[i], first_id);
    }
}

void main() {
    uint meshlet = visible_meshlets[batches[batch].first_drawn + gl_WorkGroupID.x];
    PlacedMeshlet placed = placed_meshlets[meshlet];
    VisibleItem item = items[placed.item];
    if (!drawsItem(item)) {
        return;
    }
    Meshlet m = meshlets[placed.meshlet];
    InstanceView view = instances[item.instance];
    uint lane = gl_LocalInvocationIndex;
    if (lane == 0u) {
        covering_count = 0u;
    }
    if (lane < kRounds) {
        shared_out[lane] = 0u;
    }
    projectVertices(m, item, view);
    barrier();
    uint first_triangle = m.first_word + m.vertex_count;
    uint first_id = meshlet << kTriangleBits;
    for (uint i = lane; 3u * i < m.index_count; i += kGroup) {
        keepCovering(placed, item, view, meshlet_words[first_triangle + i], first_id | i);
    }
    barrier();
    for (uint round = 0; round * kRound < covering_count; ++round) {
        uint i = round * kRound + lane;
        if (lane < kRound && i < covering_count) {
            setUp(covering[i], first_id, round);
        }
        barrier();
        drawRows(shared_out[round], first_id);
        barrier(); // before the next round writes
    }
}

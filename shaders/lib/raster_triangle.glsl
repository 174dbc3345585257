// From a triangle's corners to integer edge functions. A pixel belongs to a triangle where its
// centre does, by the top-left rule, as the rasteriser has it: triangles that share an edge leave
// no pixel between them and share none. Vertices are transformed by the same steps in every pass,
// and clipped edges cut from inside to outside, so that both of an edge's triangles see one edge.

vec4 view_from_object_0;
vec4 view_from_object_1;
vec4 view_from_object_2;
#include "lib/project.glsl"

struct ClipTriangle {
    vec4 a;
    vec4 b;
    vec4 c;
};

vec4 clipVertex(InstanceView view, uint vertex) {
    view_from_object_0 = view.row0;
    view_from_object_1 = view.row1;
    view_from_object_2 = view.row2;
    return project(toView(positions[vertex]));
}

ClipTriangle clipTriangle(PlacedMeshlet placed, VisibleItem item, InstanceView view,
                          uint triangle) {
    uint first = placed.first_index + 3u * triangle;
    uvec3 v = uvec3(indices[first], indices[first + 1u], indices[first + 2u]) + item.vertex_offset;
    return ClipTriangle(clipVertex(view, v.x), clipVertex(view, v.y), clipVertex(view, v.z));
}

vec2 halfSize() { return 0.5 * vec2(frame.camera.width_px, frame.camera.height_px); }

// In front of the near plane.
bool inFront(vec4 clip) { return clip.w >= clip.z; }

// Needs no clipping.
bool drawable(vec4 clip) {
    return inFront(clip) && all(lessThanEqual(abs(clip.xy) * halfSize(), vec2(kGuardPx * clip.w)));
}

// A corner on the screen, snapped to it.
struct Corner {
    ivec2 at;     // subpixels
    vec2 snapped; // how far it was moved
    float depth;  // where it was before
};

// In subpixels from the picture's middle, and its depth.
vec3 onScreen(vec4 clip) {
    precise vec2 ndc = clip.xy / clip.w;
    precise vec2 from_middle = ndc * (halfSize() * float(1u << kSubpixelBits));
    return vec3(from_middle, clip.z / clip.w);
}

Corner snap(vec3 on_screen) {
    ivec2 middle = ivec2(frame.camera.width_px, frame.camera.height_px) << (kSubpixelBits - 1u);
    vec2 snapped = floor(on_screen.xy + 0.5);
    return Corner(ivec2(snapped) + middle, snapped - on_screen.xy, on_screen.z);
}

Corner toScreen(vec4 clip) { return snap(onScreen(clip)); }

// Of the triangle's plane at its snapped corners, so that snapping bends no surface. Of a sliver,
// no higher than a few subpixels, the depths as they are: its plane could lead anywhere.
vec3 depthsAtCorners(Corner a, Corner b, Corner c) {
    vec3 depths = vec3(a.depth, b.depth, c.depth);
    vec2 ab = vec2(b.at - a.at) - (b.snapped - a.snapped);
    vec2 ac = vec2(c.at - a.at) - (c.snapped - a.snapped);
    float area = ab.x * ac.y - ab.y * ac.x;
    const float kLeastHeight = 8.0;
    vec2 reach = max(max(abs(ab), abs(ac)), abs(ac - ab));
    if (!(area > kLeastHeight * max(reach.x, reach.y))) {
        return depths;
    }
    vec2 rise = depths.yz - depths.x;
    vec2 slope = vec2(rise.x * ac.y - rise.y * ab.y, rise.y * ab.x - rise.x * ac.x) / area;
    return depths + vec3(dot(slope, a.snapped), dot(slope, b.snapped), dot(slope, c.snapped));
}

// Twice its area; positive where its corners are clockwise on the screen, since y points down.
int64_t doubleArea(Corner a, Corner b, Corner c) {
    ivec2 ab = b.at - a.at;
    ivec2 ac = c.at - a.at;
    return int64_t(ab.x) * int64_t(ac.y) - int64_t(ab.y) * int64_t(ac.x);
}

bool showsFace(int64_t area, bool mirrored, bool both_sides) {
    bool front = (area < 0) != mirrored;
    return area != 0 && (front || both_sides);
}

// Holds edge functions and areas of all triangles that are drawn.
#ifndef FROXEL_EDGE_INT
#define FROXEL_EDGE_INT int64_t
#endif

// Edge functions at a pixel's centre, each without its last 8 bits, which no step to another pixel
// changes; not negative inside, the rule for edges taken in. Weights of the corners are
// (inside + rest) * scale, and the depth is their sum.
struct Edges {
    ivec3 inside;
    ivec3 step_x;
    ivec3 step_y;
    vec3 rest;
    vec3 scale;
};

// Of the edge from p to q; inside is right of it as seen on the screen.
void setEdge(ivec2 p, ivec2 q, ivec2 center, uint i, inout Edges e) {
    ivec2 d = q - p;
    ivec2 from = center - p;
    FROXEL_EDGE_INT value = FROXEL_EDGE_INT(d.x) * FROXEL_EDGE_INT(from.y) -
                            FROXEL_EDGE_INT(d.y) * FROXEL_EDGE_INT(from.x);
    bool top_left = d.y < 0 || (d.y == 0 && d.x > 0);
    // Farther off than a block can lead back: its sign is all that counts.
    const FROXEL_EDGE_INT kFar = FROXEL_EDGE_INT(1 << 29);
    FROXEL_EDGE_INT kept = clamp((value - (top_left ? 0 : 1)) >> int(kSubpixelBits), -kFar, kFar);
    e.inside[i] = int(kept);
    e.rest[i] = float(value - (kept << int(kSubpixelBits))) * (1.0 / float(1u << kSubpixelBits));
    e.step_x[i] = -d.y;
    e.step_y[i] = d.x;
}

// At `pixel`, for pixels up to 63 beyond it. area: doubleArea of them, not 0.
Edges edgesAt(ivec2 pixel, Corner a, Corner b, Corner c, FROXEL_EDGE_INT area) {
    if (area < 0) {
        Corner other = b;
        b = c;
        c = other;
        area = -area;
    }
    Edges e;
    ivec2 center = (pixel << int(kSubpixelBits)) + (1 << int(kSubpixelBits - 1u));
    setEdge(b.at, c.at, center, 0, e);
    setEdge(c.at, a.at, center, 1, e);
    setEdge(a.at, b.at, center, 2, e);
    e.scale = depthsAtCorners(a, b, c) * (float(1u << kSubpixelBits) / float(area));
    return e;
}

bool isInside(ivec3 inside) { return (inside.x | inside.y | inside.z) >= 0; }

float depthAt(ivec3 inside, vec3 rest, vec3 scale) { return dot(vec3(inside) + rest, scale); }

// Leaves out the meshlets of a batch that lie behind what earlier batches of the frame drew,
// wherever they may be seen: they win no pixel, so that no bit changes. An invocation a meshlet, in
// turns; the others go to where the list of the batch before was.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : require
#define FROXEL_CAMERA_ALONE
#include "lib/frame.glsl"
#include "lib/visibility_set.glsl"
#include "lib/raster_set.glsl"
#include "lib/raster_push.glsl"
#include "lib/raster_far.glsl"
#include "lib/instance_scale.glsl"

layout(local_size_x = kRasterHiddenGroup) in;

struct ScreenBounds {
    uvec2 low; // pixels
    uvec2 high;
    float depth; // of no pixel there more
};

// False: it has none, being partly behind the near plane, or beyond the picture.
bool boundsOnScreen(InstanceView view, Meshlet m, out ScreenBounds bounds) {
    vec4 center = vec4(m.center, 1.0);
    vec3 at = vec3(dot(view.row0, center), dot(view.row1, center), dot(view.row2, center));
    // With slack for its own rounding, and for that of what it encloses.
    float radius = largestScale(view) * m.radius * 1.001 + 1e-5 * length(at);
    vec2 z = at.z + vec2(radius, -radius); // nearest, farthest
    vec2 w = frame.camera.clip_w.x + frame.camera.clip_w.y * z;
    vec2 depth = (frame.camera.clip_z.x + frame.camera.clip_z.y * z) / w;
    if (!(w.x > 0.0 && depth.x <= 1.0)) {
        return false;
    }
    vec2 a = (at.xy - radius) * frame.camera.clip_scale;
    vec2 b = (at.xy + radius) * frame.camera.clip_scale;
    vec2 least = min(a, b);
    vec2 most = max(a, b);
    least /= mix(vec2(w.x), vec2(w.y), greaterThanEqual(least, vec2(0.0)));
    most /= mix(vec2(w.y), vec2(w.x), greaterThanEqual(most, vec2(0.0)));
    vec2 size = vec2(frame.camera.width_px, frame.camera.height_px);
    vec2 low = (least + frame.camera.clip_offset + 1.0) * 0.5 * size - 1.0;
    vec2 high = (most + frame.camera.clip_offset + 1.0) * 0.5 * size + 1.0;
    if (!(all(lessThan(low, size)) && all(greaterThan(high, vec2(0.0))))) {
        return false;
    }
    bounds.low = uvec2(max(low, vec2(0.0)));
    bounds.high = uvec2(min(high, size - 1.0));
    // A triangle's plane is continued to its snapped corners, by less than an eighth of what its
    // depths differ by (depthsAtCorners).
    bounds.depth = (depth.x + 0.25 * (depth.x - depth.y)) * 1.00001;
    return true;
}

// In how many blocks of this size it lies, from the first one on.
uvec2 blocksUnder(ScreenBounds bounds, uint side) {
    return bounds.high / side - bounds.low / side + 1u;
}

bool isHidden(InstanceView view, Meshlet m) {
    ScreenBounds bounds;
    if (!boundsOnScreen(view, m, bounds)) {
        return false;
    }
    const uint kMostBlocks = 32u;
    uvec2 count = blocksUnder(bounds, kFarFine);
    bool fine = count.x * count.y <= kMostBlocks;
    uint side = fine ? kFarFine : kFarCoarse;
    count = blocksUnder(bounds, side);
    if (count.x * count.y > kMostBlocks) {
        return false;
    }
    uint row_blocks = blocksOf(side).x;
    uvec2 low = bounds.low / side;
    uint first = (fine ? 0u : coarseBlocksBegin()) + low.y * row_blocks + low.x;
    for (uint y = 0; y < count.y; ++y) {
        for (uint x = 0; x < count.x; ++x) {
            if (!(far_depths[first + y * row_blocks + x] > bounds.depth)) {
                return false;
            }
        }
    }
    return true;
}

bool mayBeSeen(uint meshlet) {
    PlacedMeshlet placed = placed_meshlets[meshlet];
    VisibleItem item = items[placed.item];
    return item.bends != 0u || !isHidden(instances[item.instance], meshlets[placed.meshlet]);
}

void main() {
    uint first = batches[batch].first;
    uint count = batches[batch].listed.x;
    for (uint i = gl_GlobalInvocationID.x; i < count;
         i += gl_NumWorkGroups.x * kRasterHiddenGroup) {
        uint meshlet = visible_meshlets[first + i];
        if (mayBeSeen(meshlet)) {
            uint place = atomicAdd(batches[batch].drawn.x, 1u);
            visible_meshlets[batches[batch].first_drawn + place] = meshlet;
        }
    }
}

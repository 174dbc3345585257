// Whether a meshlet lies behind what earlier batches of the frame drew, wherever it may be seen: it
// wins no pixel then, so that leaving it out changes no bit. All of a workgroup ask together.
#include "lib/instance_scale.glsl"
#include "lib/raster_far.glsl"

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

shared uint may_be_seen;

// In how many blocks of this size it lies, from the first one on.
uvec2 blocksUnder(ScreenBounds bounds, uint side) {
    return bounds.high / side - bounds.low / side + 1u;
}

bool isHidden(InstanceView view, Meshlet m) {
    ScreenBounds bounds;
    if (!boundsOnScreen(view, m, bounds)) {
        return false;
    }
    uvec2 count = blocksUnder(bounds, kFarFine);
    bool fine = count.x * count.y <= kRasterGroup;
    uint side = fine ? kFarFine : kFarCoarse;
    count = blocksUnder(bounds, side);
    if (count.x * count.y > kRasterGroup) {
        return false;
    }
    uint lane = gl_LocalInvocationIndex;
    if (lane == 0u) {
        may_be_seen = 0u;
    }
    barrier();
    if (lane < count.x * count.y) {
        uvec2 block = bounds.low / side + uvec2(lane % count.x, lane / count.x);
        uint begin = fine ? 0u : coarseBlocksBegin();
        if (!(far_depths[begin + block.y * blocksOf(side).x + block.x] > bounds.depth)) {
            may_be_seen = 1u;
        }
    }
    barrier();
    return may_be_seen == 0u;
}

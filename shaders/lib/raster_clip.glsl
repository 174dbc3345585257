// Clips triangles to the near plane and the guard band (Sutherland and Hodgman 1974).

const uint kNearPlane = 0u;
const uint kClipPlanes = 5u; // then the guard band's four
const uint kMostCorners = 3u + kClipPlanes;

// Not negative inside.
float insidePlane(vec4 clip, uint plane) {
    switch (plane) {
    case kNearPlane:
        return clip.w - clip.z;
    case 1:
        return kGuardPx * clip.w + clip.x * halfSize().x;
    case 2:
        return kGuardPx * clip.w - clip.x * halfSize().x;
    case 3:
        return kGuardPx * clip.w + clip.y * halfSize().y;
    default:
        return kGuardPx * clip.w - clip.y * halfSize().y;
    }
}

// Where the edge from a corner inside to one outside meets the plane.
vec4 cutEdge(vec4 inside, vec4 outside, uint plane) {
    precise float from = insidePlane(inside, plane);
    precise float share = from / (from - insidePlane(outside, plane));
    precise vec4 cut = inside + share * (outside - inside);
    if (plane == kNearPlane) { // there w = z, and one of them is the same everywhere
        if (frame.camera.orthographic != 0.0) {
            cut.z = cut.w;
        } else {
            cut.w = cut.z;
        }
    }
    return cut;
}

// Returns how many corners are left.
uint clipCorners(inout vec4 corners[kMostCorners], uint count) {
    for (uint plane = 0; plane < kClipPlanes; ++plane) {
        vec4 kept[kMostCorners];
        uint reused_count = 0;
        for (uint i = 0; i < count; ++i) {
            vec4 a = corners[i];
            vec4 b = corners[i + 1u < count ? i + 1u : 0u];
            bool a_inside = insidePlane(a, plane) >= 0.0;
            bool b_inside = insidePlane(b, plane) >= 0.0;
            if (a_inside) {
                kept[reused_count++] = a;
            }
            if (a_inside != b_inside) {
                kept[reused_count++] = a_inside ? cutEdge(a, b, plane) : cutEdge(b, a, plane);
            }
        }
        corners = kept;
        count = reused_count;
    }
    return count;
}

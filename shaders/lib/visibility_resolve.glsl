// What the visibility passes share: the pixel's id, and which dispatch takes the pixel.
layout(set = 2, binding = 13) uniform utexture2D id_image;

// kAnyMaterial, or the one whose textures are bound.
layout(push_constant) uniform ResolveBlock {
    uint only_material;
    uint resolve_flags;
};

// Whether this dispatch shades a pixel that shows `id`.
bool mine(uint id) {
    uint item = placed_meshlets[id >> kTriangleBits].item;
    bool asked = only_material == kAnyMaterial || items[item].material_index == only_material;
    if ((resolve_flags & kResolveLayers) != 0u) {
        asked = asked && (items[item].flags & kMaterialLayers) != 0u;
    }
    return asked;
}

// Of the compute raster's depths, and of what replaces them.
layout(set = 2, binding = 19, r32f) uniform writeonly image2D depth_store;

// Where the ray of a pixel that shows the triangle meets its plane, metres along the view axis. An
// interpolated depth is off by 2^-24 distance / near of the distance, this by 2^-24 distance over
// the eye's own distance from the plane. `interpolated` is what is left for a triangle seen
// edge-on.
float planeDistance(VisibleTriangle t, uvec2 pixel, float interpolated) {
    // The corner next to the eye: with a far one the digits of what is near would cancel.
    vec3 anchor = dot(t.corner1, t.corner1) < dot(t.corner, t.corner) ? t.corner1 : t.corner;
    anchor = dot(t.corner2, t.corner2) < dot(anchor, anchor) ? t.corner2 : anchor;
    precise vec2 ray = (vec2(pixel) + 0.5) * frame.camera.ray_scale + frame.camera.ray_offset;
    precise vec3 from_eye = anchor - vec3(ray * frame.camera.ray_spread.x, 0.0);
    precise vec3 n = vec3(t.edge1.y * t.edge2.z - t.edge1.z * t.edge2.y,
                          t.edge1.z * t.edge2.x - t.edge1.x * t.edge2.z,
                          t.edge1.x * t.edge2.y - t.edge1.y * t.edge2.x);
    precise float towards = (n.x * ray.x + n.y * ray.y) * frame.camera.ray_spread.y - n.z;
    precise float distance = (n.x * from_eye.x + n.y * from_eye.y + n.z * from_eye.z) / towards;
    // Between its corners, also where it is thinner than coordinates are exact.
    vec3 corners = -vec3(t.corner.z, t.corner1.z, t.corner2.z);
    float nearest = max(min(min(corners.x, corners.y), corners.z), distanceFromDepth(1.0));
    float farthest = max(max(max(corners.x, corners.y), corners.z), nearest);
    return towards != 0.0 ? clamp(distance, nearest, farthest) : interpolated;
}

// Of the surface that a covered pixel shows; the passes that follow find the same.
float solidDistance(VisibleTriangle t, uvec2 pixel, float depth) {
    if (!hasOutput(kOutputDepth) || (resolve_flags & kResolveReused) != 0u) {
        return distanceFromDepth(depth);
    }
    float distance = planeDistance(t, pixel, distanceFromDepth(depth));
    precise float stored = (frame.camera.clip_z.x - frame.camera.clip_z.y * distance) /
                           (frame.camera.clip_w.x - frame.camera.clip_w.y * distance);
    imageStore(depth_store, ivec2(pixel), vec4(stored));
    return distanceFromDepth(stored);
}

#include "lib/instance_scale.glsl"

// Which meshlets of a mesh with coarser levels a view takes: as render::DetailChoice.
layout(set = 2, binding = 21, scalar) readonly buffer DetailBlock { MeshletDetail details[]; };

// A point at depth z, whose ray is o times as long, moves by no more than pixels * o / z for each
// metre that it is moved.
bool isEnough(InstanceView view, float scale, DetailError detail) {
    if (detail.error == 0.0) {
        return true;
    }
    vec2 half_px = 0.5 * vec2(frame.camera.width_px, frame.camera.height_px);
    vec2 pixels = abs(frame.camera.clip_scale) * half_px;
    float error_px = max(pixels.x, pixels.y) * scale * detail.error;
    if (frame.camera.orthographic != 0.0 || isinf(error_px)) {
        return error_px <= frame.camera.geometry_error_px;
    }
    vec4 center = vec4(detail.center, 1.0);
    vec3 at = vec3(dot(view.row0, center), dot(view.row1, center), dot(view.row2, center));
    float reach = detail.radius * scale;
    float depth = -at.z - reach;
    if (!(depth >= frame.camera.clip_z.x)) { // the near plane
        return false;
    }
    vec2 corner = (1.0 + abs(frame.camera.clip_offset)) / frame.camera.clip_scale;
    float oblique = min((length(at) + reach) / depth, sqrt(1.0 + dot(corner, corner)));
    return error_px * oblique <= frame.camera.geometry_error_px * depth;
}

bool drawsDetail(InstanceView view, MeshletDetail detail) {
    float scale = largestScale(view);
    return isEnough(view, scale, detail.own) && !isEnough(view, scale, detail.coarser);
}

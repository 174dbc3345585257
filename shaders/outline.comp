// Toon renderers: darkens the pixels near an edge. Stored depth is affine over a plane, so of three
// pixels in a row on one plane the middle one has the mean of the others' depths, however steep the
// plane: where it has more, a surface ends that is nearer than what is behind. Lines lie on that
// one. A crease is where normals differ; its line lies on one side.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "lib/frame.glsl"
#include "lib/gbuffer.glsl"
#include "lib/tonemap.glsl"
#include "lib/screen.glsl"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;

const float kDepthStep = 0.05;   // share of the nearest one's depth
const float kCreaseCosine = 0.5; // 60 degrees: above what normal maps turn by

float depthAt(ivec2 at) { return texelFetch(depth_image, at, 0).x; }

vec3 normalAt(ivec2 at) {
    uvec4 extra = readsExtra() ? texelFetch(extra_image, at, 0) : uvec4(0u);
    return unpackGbuffer(texelFetch(gbuffer_image, at, 0), extra).normal_view;
}

// Whether the pixel's surface ends or folds within `reach` pixels of it.
bool edgeWithin(ivec2 at, int reach) {
    const ivec2 kDirections[4] = ivec2[](ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(1, -1));
    ivec2 last = ivec2(frame.camera.width_px, frame.camera.height_px) - 1;
    float middle = depthAt(at);
    for (int i = 0; i < 4; ++i) {
        ivec2 a = at + reach * kDirections[i];
        ivec2 b = at - reach * kDirections[i];
        if (any(lessThan(min(a, b), ivec2(0))) || any(greaterThan(max(a, b), last))) {
            continue; // where the picture ends nothing is known
        }
        float depth_a = depthAt(a);
        float depth_b = depthAt(b);
        float nearest = max(middle, max(depth_a, depth_b));
        float ends = 2.0 * middle - depth_a - depth_b;
        bool steps = abs(ends) > kDepthStep * nearest;
        if (steps && ends > 0.0) {
            return true;
        }
        if (!steps && min(middle, depth_a) > 0.0 &&
            dot(normalAt(at), normalAt(a)) < kCreaseCosine) {
            return true;
        }
    }
    return false;
}

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (!insideScreen(pixel)) {
        return;
    }
    ivec2 at = ivec2(pixel);
    // A reach between two pixels darkens the farther one in part.
    int whole = int(frame.outline_reach_px);
    float part = frame.outline_reach_px - float(whole);
    float edge = edgeWithin(at, whole) ? 1.0 : part > 0.0 && edgeWithin(at, whole + 1) ? part : 0.0;
    if (edge > 0.0) {
        vec4 before = imageLoad(radiance_image, at);
        vec3 color = before.rgb * (1.0 - frame.outline_strength * edge);
        imageStore(radiance_image, at, vec4(color, before.a));
    }
}

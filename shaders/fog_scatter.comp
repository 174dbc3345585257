// What lights scatter towards the eye in each slice of the volume: radiance for each unit of what
// the slice takes of light, as a mean over its stretch of the node's ray. 1 / d^2 is averaged in
// closed form (Sun et al. 2005, "A practical analytic single scattering model"), the phase by
// Simpson's rule over the angle that the light sees the stretch at; window, cone and what is lost
// between light and sample are taken at one place, whose cluster's list is complete there. d^2 is
// widened by a share of a tile, since narrower glows would flicker between nodes.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "lib/frame.glsl"
#include "lib/light_loop.glsl"
#include "lib/fog.glsl"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;
layout(set = 1, binding = 0, scalar) writeonly buffer VolumeBlock { vec4 volume[]; };

// Of tiles, 1 / (2 sqrt(pi)): a ray through the lamp sees the mean over a tile.
const float kWidth = 0.28;

// A slice of a node's ray.
struct Stretch {
    vec3 origin_view;
    vec3 direction_view; // unit
    vec3 sample_view;
    float front_m; // from the origin
    float back_m;
    float width2; // m^2
};

// In the angle equal steps weigh alike, as 1 / d^2 does. `h`: from the ray; the ends are counted
// from the place nearest to the light.
float meanPhase(float h, float front, float back) {
    precise vec2 a = vec2(h, front) * inversesqrt(fma(front, front, h * h));
    precise vec2 b = vec2(h, back) * inversesqrt(fma(back, back, h * h));
    precise vec2 sum = a + b;
    precise float middle = sum.y * inversesqrt(dot(sum, sum));
    precise float mean = (phase(-a.y) + 4.0 * phase(-middle) + phase(-b.y)) / 6.0;
    return mean;
}

vec3 scatteredBy(Stretch s, LocalLight light) {
    precise vec3 to_light = light.position_view - s.sample_view;
    precise float d2 =
        fma(to_light.z, to_light.z, fma(to_light.y, to_light.y, to_light.x * to_light.x));
    precise float x = d2 * light.inv_radius2;
    precise vec3 from_origin = light.position_view - s.origin_view;
    precise float along = dot(from_origin, s.direction_view);
    precise vec3 beside = cross(from_origin, s.direction_view);
    precise float h2 = dot(beside, beside) + s.width2;
    precise float h = sqrt(h2);
    precise float front = s.front_m - along;
    precise float back = s.back_m - along;
    precise float span = h * (s.back_m - s.front_m);
    precise float inverse_d2 = atan(span, fma(front, back, h2)) / span;
    precise float kept = exp(-opticalDepth(light.position_view, s.sample_view));
    precise float share = rangeWindow(x) * inverse_d2 * meanPhase(h, front, back) * kept;
    if (hasLight(kLightSpots)) {
        share *= coneShare(light, to_light);
    }
    if (hasLight(kLightShadows) && light.shadow != kNoShadow) {
        share *= shadowInAir(s.sample_view, light.shadow);
    }
    precise vec3 scattered = light.color * share;
    return scattered;
}

// At the sample alone: a rectangle is no needle that nodes could miss.
vec3 scatteredByArea(Stretch s, LocalLight light, AreaRect rect) {
    vec3 to_light = light.position_view - s.sample_view;
    precise float d2 = dot(to_light, to_light);
    precise float along = dot(to_light, s.direction_view) * inversesqrt(max(d2, kLeastDistance2));
    precise float kept = exp(-opticalDepth(light.position_view, s.sample_view));
    precise float share = rangeWindow(d2 * light.inv_radius2) * solidAngle(to_light, rect) *
                          rect.inv_area * phase(along) * kept * coneShare(light, to_light);
    precise vec3 scattered = light.color * share;
    return scattered;
}

vec3 scatteredByAreas(Stretch s, bool all_lights, ClusterList list) {
    precise vec3 sum = vec3(0.0);
    uint left = list.count;
    LocalLight light;
    AreaRect rect;
    while (nextArea(list, all_lights, left, light, rect)) {
        sum += scatteredByArea(s, light, rect);
    }
    return sum;
}

// As addListPlain: each invocation walks its own list.
vec3 scatteredByAll(Stretch s, uvec2 pixel, float distance) {
    bool all_lights = !hasLight(kLightLists);
    uint cluster = all_lights ? kNoCluster : clusterAt(pixel, distance);
    ClusterList list = ClusterList(0u, 0u);
    if (all_lights) {
        list.count = frame.light_count;
    } else if (cluster != kNoCluster) {
        list = fetchList(cluster);
    }
    precise vec3 sum = vec3(0.0);
    for (uint first = 0; first < list.count; first += kPlainStep) {
        [[unroll]] for (uint k = 0; k < kPlainStep; ++k) {
            uint i = first + k;
            if (kPlainStep == 1 || i < list.count) {
                uint index = all_lights ? i : fetchIndex(list.offset + i);
                sum += scatteredBy(s, fetchLight(index));
            }
        }
    }
    if (hasLight(kLightAreas)) {
        sum += scatteredByAreas(s, all_lights, list);
    }
    return sum;
}

// 0 to 1 exclusive, as if at random (PCG, Jarzynski and Olano 2020).
float jitter(uvec3 froxel) {
    uint state = fogTexelOf(froxel) * 747796405u + fog.seed;
    uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (float(((word >> 22) ^ word) & 0xffffu) + 0.5) / 65536.0;
}

void main() {
    uvec3 froxel = gl_GlobalInvocationID;
    if (any(greaterThanEqual(froxel, uvec3(fog.node_count_x, fog.node_count_y, fog.slice_count)))) {
        return;
    }
    uvec2 pixel = nodePixel(froxel.xy);
    float begin = fogPlane(froxel.z);
    float end = fogPlane(froxel.z + 1u);
    float place = hasOutput(kOutputFogNoise) ? jitter(froxel) : 0.5;
    float distance = mix(begin, end, place);
    Stretch s;
    s.origin_view = positionFromDistance(pixel, 0.0);
    vec3 back = positionFromDistance(pixel, end) - s.origin_view;
    s.back_m = length(back);
    s.direction_view = back / s.back_m;
    s.front_m = s.back_m * (begin / end);
    s.sample_view = positionFromDistance(pixel, distance);
    vec2 tile = abs(frame.camera.ray_scale) * float(fog.tile_px) *
                (frame.camera.ray_spread.x + frame.camera.ray_spread.y * distance);
    s.width2 = kWidth * kWidth * tile.x * tile.y + 1.0 / mostInverse2();
    vec3 scattered = min(scatteredByAll(s, pixel, distance), vec3(1e30));
    volume[fogTexelOf(froxel)] = vec4(fog.albedo * scattered, 1.0);
}

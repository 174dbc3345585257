// Sums every light that reaches a surface, in ascending light index, in fp32. One light function
// for every renderer; the loops below differ in how they fetch, never in what they add.
#include "lib/brdf.glsl"

// A light as it is fetched; a point light's cone lets everything through: 0 * x + 1.
struct LocalLight {
    vec3 position_view;
    float inv_radius2;
    vec3 color;
    vec3 cone_direction;
    float cone_scale;
    float cone_offset;
};

LocalLight darkLight() {
    return LocalLight(vec3(0.0), 0.0, vec3(0.0), vec3(0.0), 0.0, 1.0);
}

LocalLight fetchLight(uint index) {
    vec4 a = texelFetch(light_texels, int(2u * index));
    vec4 b = texelFetch(light_texels, int(2u * index + 1u));
    LocalLight light = LocalLight(a.xyz, a.w, b.xyz, vec3(0.0), 0.0, 1.0);
    if (hasLight(kLightSpots)) {
        uint spot = floatBitsToUint(b.w);
        if (spot != kNoSpot) {
            vec4 c = texelFetch(spot_texels, int(2u * spot));
            light.cone_direction = c.xyz;
            light.cone_scale = c.w;
            light.cone_offset = texelFetch(spot_texels, int(2u * spot + 1u)).x;
        }
    }
    return light;
}

ClusterList fetchList(uint cluster) {
    uvec2 list = texelFetch(list_texels, int(cluster)).xy;
    return ClusterList(list.x, list.y);
}

uint fetchIndex(uint entry) { return texelFetch(index_texels, int(entry)).x; }

// share: 1, or 0 where the light is not this invocation's.
void addLocalLight(Surface s, LocalLight light, float share, inout LightSum sum) {
    vec3 to_light = light.position_view - s.position_view;
    if (hasLight(kLightSpots)) {
        precise float inv_d = inversesqrt(max(dot(to_light, to_light), kEpsilon2));
        precise float towards = -dot(light.cone_direction, to_light) * inv_d;
        precise float f = clamp(fma(towards, light.cone_scale, light.cone_offset), 0.0, 1.0);
        share *= f * f;
    }
    addLight(s, to_light, light.inv_radius2, light.color, share, sum);
}

// Each invocation walks its own list: loads are per invocation.
void addListPlain(Surface s, bool lit, bool all_lights, uint cluster, inout LightSum sum) {
    ClusterList list = ClusterList(0u, 0u);
    if (lit && all_lights) {
        list.count = frame.light_count;
    } else if (lit) {
        list = fetchList(cluster);
    }
    for (uint i = 0; i < list.count; ++i) {
        uint index = all_lights ? i : fetchIndex(list.offset + i);
        addLocalLight(s, fetchLight(index), 1.0, sum);
    }
}

#ifdef FROXEL_SUBGROUPS
// The subgroup fetches BATCH_SIZE lights at a time, one an invocation, and hands each to all: an
// eighth of the loads on an 8-wide software rasteriser, where loads cost more than the arithmetic.
// A shuffle by a literal is one instruction there; a broadcast searches for an active invocation.
// A light past the end of the list has no colour and adds exactly 0.
// Loops test at their end: llvmpipe runs a body once more, masked, where the test comes first.
void addBatches(Surface s, bool all_lights, ClusterList list, float share, inout LightSum sum) {
    uint first = 0;
    do {
        uint slot = first + gl_SubgroupInvocationID;
        LocalLight mine = darkLight();
        if (slot < list.count) {
            mine = fetchLight(all_lights ? slot : fetchIndex(list.offset + slot));
        }
        [[unroll]] for (uint k = 0; k < BATCH_SIZE; ++k) {
            LocalLight light = darkLight();
            light.position_view = subgroupShuffle(mine.position_view, k);
            light.inv_radius2 = subgroupShuffle(mine.inv_radius2, k);
            light.color = subgroupShuffle(mine.color, k);
            if (hasLight(kLightSpots)) {
                light.cone_direction = subgroupShuffle(mine.cone_direction, k);
                light.cone_scale = subgroupShuffle(mine.cone_scale, k);
                light.cone_offset = subgroupShuffle(mine.cone_offset, k);
            }
            addLocalLight(s, light, share, sum);
        }
        first += BATCH_SIZE;
    } while (first < list.count);
}

// Every invocation of the subgroup must arrive here; `lit` is false where there is nothing to
// light. Lists are taken one after the other; an invocation counts only its own (share 1, else 0),
// so each sums its own list in order, as addListPlain does.
void addListBatched(Surface s, bool lit, bool all_lights, uint cluster, inout LightSum sum) {
    if (all_lights) {
        if (subgroupAny(lit)) {
            addBatches(s, true, ClusterList(0u, frame.light_count), 1.0, sum);
        }
        return;
    }
    uint wanted = lit ? cluster : kNoCluster;
    uint current = subgroupMin(wanted);
    do {
        bool mine = wanted == current;
        ClusterList list = ClusterList(0u, 0u);
        if (current != kNoCluster) {
            list = fetchList(current);
        }
        addBatches(s, false, list, mine ? 1.0 : 0.0, sum);
        wanted = mine ? kNoCluster : wanted;
        current = subgroupMin(wanted);
    } while (current != kNoCluster);
}
#endif

// All lights of the frame on one surface. Where lists are batched every invocation of the subgroup
// must call this; elsewhere `lit` is true.
LightSum sumLights(Surface s, uvec2 pixel, float distance, bool lit) {
    LightSum sum = noLight();
    if (hasLight(kLightLocal)) {
        bool all_lights = !hasLight(kLightLists);
        uint cluster = all_lights || !lit ? kNoCluster : clusterAt(pixel, distance);
        bool reached = lit && (all_lights || cluster != kNoCluster);
        bool whole = false;
#ifdef FROXEL_SUBGROUPS
        if (hasLight(kLightBatched)) {
            // At a triangle's edge a subgroup of fragments lacks some of its invocations, and with
            // them the lights that they would have fetched.
            whole = !hasLight(kLightPartial) ||
                    subgroupBallotBitCount(subgroupBallot(true)) == BATCH_SIZE;
            addListBatched(s, reached && whole, all_lights, cluster, sum);
        }
#endif
        if (!hasLight(kLightBatched) || hasLight(kLightPartial)) {
            addListPlain(s, reached && !whole, all_lights, cluster, sum);
        }
    }
    if (hasLight(kLightDirectional)) {
        for (uint i = 0; i < frame.directional_count; ++i) {
            vec3 l = -suns[i].direction_view;
            addIrradiance(s, dot(s.normal_view, l), dot(s.to_eye_view, l), 1.0, suns[i].color, sum);
        }
    }
    return sum;
}

// A hemisphere of constant radiance from the sky and from the ground.
vec3 ambientRadiance(Surface s, vec3 base_color, float metallic, float occlusion) {
    vec3 sky = mix(frame.ambient_ground, frame.ambient_sky,
                   fma(0.5, dot(s.normal_view, frame.up_view), 0.5));
    vec3 f0 = mix(vec3(0.04), base_color, metallic);
    return sky * (base_color * (1.0 - metallic) + f0) * occlusion;
}

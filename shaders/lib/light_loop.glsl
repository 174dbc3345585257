// Sums every light that reaches a surface, in ascending light index, in fp32. One light function
// for every renderer; the loops below differ in how they fetch and in what they can skip, never in
// what they add.
#include "lib/light_fetch.glsl"
#include "lib/area_loop.glsl"
#include "lib/environment.glsl"
#ifdef FROXEL_SUBGROUPS
#include "lib/light_block.glsl"
#endif

// llvmpipe ends a shader's loops after 65,535 iterations, all loops together: where more lights
// come, an iteration takes several (kLightLong).
const uint kPlainStep = (LIGHT_FLAGS & kLightLong) != 0 ? 16 : 1;
const uint kBatchStep = (LIGHT_FLAGS & kLightLong) != 0 ? 2 : 1;

// Each invocation walks its own list: loads are per invocation.
void addListPlain(Surface s, bool lit, bool all_lights, uint cluster, inout LightSum sum) {
    ClusterList list = ClusterList(0u, 0u);
    if (lit && all_lights) {
        list.count = frame.light_count;
    } else if (lit) {
        list = fetchList(cluster);
    }
    for (uint first = 0; first < list.count; first += kPlainStep) {
        [[unroll]] for (uint k = 0; k < kPlainStep; ++k) {
            uint i = first + k;
            if (kPlainStep == 1 || i < list.count) {
                uint index = all_lights ? i : fetchIndex(list.offset + i);
                addLocalLight(s, fetchLight(index), 1.0, sum);
            }
        }
    }
}

#ifdef FROXEL_SUBGROUPS
// This invocation's light out of the next BATCH_SIZE of a list; past its end a light that adds +0.
LocalLight fetchOfBatch(bool all_lights, ClusterList list, uint first) {
    uint slot = first + gl_SubgroupInvocationID;
    LocalLight light = darkLight();
    if (slot < list.count) {
        light = fetchLight(all_lights ? slot : fetchIndex(list.offset + slot));
    }
    return light;
}

// The subgroup fetches BATCH_SIZE lights at a time, one an invocation, and hands each to all: an
// eighth of the loads on an 8-wide software rasteriser, where loads cost more than the arithmetic.
// A shuffle by a literal is one instruction there; a broadcast searches for an active invocation.
// Loops test at their end: llvmpipe runs a body once more, masked, where the test comes first.
void addBatches(Surface s, bool all_lights, ClusterList list, float share, inout LightSum sum) {
    uint first = 0;
    do {
        [[unroll]] for (uint step = 0; step < kBatchStep; ++step) {
            LocalLight mine = fetchOfBatch(all_lights, list, first);
            // A last batch of 32 is mostly dark where lights are few.
            uint count = min(list.count - min(first, list.count), BATCH_SIZE);
            if (kSoftwareSubgroup || count == BATCH_SIZE) {
                [[unroll]] for (uint k = 0; k < BATCH_SIZE; ++k) {
                    addLocalLight(s, shuffleLight(mine, k), share, sum);
                }
            } else {
                for (uint k = 0; k < count; ++k) {
                    addLocalLight(s, shuffleLight(mine, k), share, sum);
                }
            }
            first += BATCH_SIZE;
        }
    } while (first < list.count);
}

// The same, but each invocation first tests its light against the bounds of what is shaded, and
// only the lights that pass are handed round (Sponza: 13 of 42).
void addCulledBatches(Surface s, ClusterList list, bool mine, float share, inout LightSum sum) {
    Block block = makeBlock(s, mine);
    uint first = 0;
    do {
        uint slot = first + gl_SubgroupInvocationID;
        bool inside = slot < list.count;
        uint index = fetchIndex(list.offset + (inside ? slot : 0u));
        LocalLight light = fetchReach(index);
        bool passes = inside && mayLight(block, light);
        if (passes) {
            fetchColor(index, light);
        }
        uint left = gatherBits(passes);
        offerLight(light);
        // Where none passes, this adds the +0 of one that did not.
        do {
            // The exponent of the lowest bit: findLSB is a dozen instructions in software.
            uint lowest = left & -left;
            uint k = ((floatBitsToUint(float(int(lowest))) >> 23) - 127u) & (BATCH_SIZE - 1u);
            left ^= lowest;
            addLocalLight(s, takeLight(light, k), share, sum);
        } while (left != 0u);
        takenLights();
        first += BATCH_SIZE;
    } while (first < list.count);
}

// Every invocation of the subgroup must arrive here; `lit` is false where there is nothing to
// light. Lists are taken one after the other; an invocation counts only its own, so each sums its
// own list in order, as addListPlain does.
void addListBatched(Surface s, bool lit, bool all_lights, uint cluster, inout LightSum sum) {
    if (all_lights) {
        if (subgroupAny(lit)) {
            addBatches(s, true, ClusterList(0u, frame.light_count), 1.0, sum);
        }
        return;
    }
    uint wanted = lit ? cluster : kNoCluster;
    uint current = leastOfBlock(wanted);
    do {
        bool mine = wanted == current;
        ClusterList list = ClusterList(0u, 0u);
        if (current != kNoCluster) {
            list = fetchList(current);
        }
        // A surface without a normal faces no light and is given +0; but a ramp may lift even that.
        Surface shaded = s;
        float share = 1.0;
        if (hasLight(kLightToon)) {
            share = mine ? 1.0 : 0.0;
        } else {
            shaded.normal_view = mine ? s.normal_view : vec3(0.0);
            if (!mine) {
                hideLayers(shaded);
            }
        }
        if (hasLight(kLightCulled)) {
            addCulledBatches(shaded, list, mine, share, sum);
        } else {
            addBatches(shaded, false, list, share, sum);
        }
        wanted = mine ? kNoCluster : wanted;
        current = leastOfBlock(wanted);
    } while (current != kNoCluster);
}
#endif

// All lights of the frame on one surface. Where lists are batched every invocation of the subgroup
// must call this; elsewhere `lit` is true.
LightSum sumLights(Surface s, uvec2 pixel, float distance, bool lit) {
    LightSum sum = noLight();
    if (hasLight(kLightLocal)) {
        if (hasLight(kLightShadows)) {
            s.shadows = findShadows(s, lit);
            findShadowsOfLayers(lit, s);
        }
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
        if (hasLight(kLightAreas) && reached) {
            addAreas(s, all_lights, cluster, sum);
        }
    }
    if (hasLight(kLightDirectional)) {
        for (uint i = 0; i < frame.directional_count; ++i) {
            vec3 l = -suns[i].direction_view;
            addIrradiance(s, l, dot(s.normal_view, l), dot(s.to_eye_view, l), 1.0, 0.0,
                          suns[i].color, sum);
            addToLayers(s, sum,
                        addIrradiance(layer, l, dot(layer.normal_view, l),
                                      dot(layer.to_eye_view, l), 1.0, 0.0, suns[i].color,
                                      of_layer));
        }
    }
    if (hasLight(kLightRim) && s.n_dot_v < frame.toon_rim_width) {
        sum.diffuse *= frame.toon_rim;
        sum.edge *= frame.toon_rim;
        brightenLayers(frame.toon_rim, sum);
    }
    return sum;
}

// Of a hemisphere about a normal.
vec3 skyRadiance(vec3 normal_view) {
    precise vec3 radiance = mix(frame.ambient_ground, frame.ambient_sky,
                                fma(0.5, dot(normal_view, frame.up_view), 0.5));
    return radiance;
}

// Of light from around, where the frame has it. Else of a hemisphere of constant radiance from the
// sky and from the ground, of which a surface returns its base colour and its f0; the less of its
// base colour the more its dielectric part reflects.
vec3 ambientRadiance(Surface s, vec3 base_color, float metallic, Dielectric dielectric,
                     float occlusion) {
    if (hasLight(kLightEnvironment)) {
        return environmentRadiance(s, base_color, metallic, dielectric, occlusion);
    }
    vec3 sky = skyRadiance(s.normal_view);
    if (hasLight(kLightLambert)) {
        if (transmits()) {
            occlusion *= scatteredShare(s);
        }
        precise vec3 lambert = sky * base_color * occlusion;
        return lambert;
    }
    precise vec3 f0 = mix(dielectric.f0, base_color, metallic);
    precise vec3 albedo = base_color * (1.0 - metallic);
    if (!dielectric.usual) {
        albedo *= entering(dielectric) / (1.0 - kDielectricF0);
    }
    if (transmits()) {
        albedo *= scatteredShare(s);
    }
    precise vec3 lit = sky * (albedo + f0) * occlusion;
    if (scattersLightFromBehind()) {
        float white = (1.0 - metallic) * (entering(dielectric) / (1.0 - kDielectricF0));
        vec3 behind = skyRadiance(-s.normal_view) * (white * scatteredShare(s));
        lit = (sky * f0 + withLightFromBehind(s, sky * albedo, behind)) * occlusion;
    }
    return lit;
}

// Bounds of the surfaces that a subgroup shades, against which each invocation tests one light, so
// that only lights that can add anything are evaluated. What is left out would have added +0: the
// distance to the box is computed by the same monotonic steps as a pixel's own, and the facing test
// has a margin for rounding.

// Not max(): that asks for NaN first on a software rasteriser. Written out: a loop over doubling
// steps is not unrolled there.
vec3 largest(vec3 a, vec3 b) {
    return vec3(a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z);
}

vec3 largestOfBlock(vec3 v) {
    v = BATCH_SIZE > 1 ? largest(v, subgroupShuffleXor(v, 1)) : v;
    v = BATCH_SIZE > 2 ? largest(v, subgroupShuffleXor(v, 2)) : v;
    v = BATCH_SIZE > 4 ? largest(v, subgroupShuffleXor(v, 4)) : v;
    v = BATCH_SIZE > 8 ? largest(v, subgroupShuffleXor(v, 8)) : v;
    return BATCH_SIZE > 16 ? largest(v, subgroupShuffleXor(v, 16)) : v;
}

// At most 8 invocations: a software rasteriser, where ballots and reductions are loops and a
// shuffle is one instruction. Elsewhere they are one instruction, and a shuffle waits.
const bool kSoftwareSubgroup = BATCH_SIZE <= 8;

// Bit i: whether invocation i passes; at most 32 invocations.
uint gatherBits(bool passes) {
    if (!kSoftwareSubgroup) {
        return subgroupBallot(passes).x;
    }
    uint bits = passes ? 1u << gl_SubgroupInvocationID : 0u;
    bits |= BATCH_SIZE > 1 ? subgroupShuffleXor(bits, 1) : 0u;
    bits |= BATCH_SIZE > 2 ? subgroupShuffleXor(bits, 2) : 0u;
    return bits | (BATCH_SIZE > 4 ? subgroupShuffleXor(bits, 4) : 0u);
}

// Of a whole subgroup.
uint leastOfBlock(uint v) {
    if (!kSoftwareSubgroup) {
        return subgroupMin(v);
    }
    v = BATCH_SIZE > 1 ? min(v, subgroupShuffleXor(v, 1)) : v;
    v = BATCH_SIZE > 2 ? min(v, subgroupShuffleXor(v, 2)) : v;
    return BATCH_SIZE > 4 ? min(v, subgroupShuffleXor(v, 4)) : v;
}

// How the lights that pass go round: in compute on a GPU through shared memory, where a load is
// cheaper than the shuffles of a light's parts; elsewhere by shuffles.
#ifdef FROXEL_SHARED_LIGHTS
const uint kSharedLights = kSoftwareSubgroup ? 1 : 64; // a workgroup's invocations
const uint kSharedSpots = (LIGHT_FLAGS & kLightSpots) != 0 ? kSharedLights : 1;
shared vec4 shared_reach[kSharedLights]; // position, inverse square radius
shared vec3 shared_color[kSharedLights];
shared vec4 shared_cone[kSharedSpots]; // direction, scale
shared float shared_cone_offset[kSharedSpots];
const uint kSharedShadows = (LIGHT_FLAGS & kLightShadows) != 0 ? kSharedLights : 1;
shared uint shared_shadow[kSharedShadows];

// Of this invocation, to its subgroup.
void offerLight(LocalLight light) {
    if (!kSoftwareSubgroup) {
        uint slot = gl_SubgroupID * BATCH_SIZE + gl_SubgroupInvocationID;
        shared_reach[slot] = vec4(light.position_view, light.inv_radius2);
        shared_color[slot] = light.color;
        if (hasLight(kLightSpots)) {
            shared_cone[slot] = vec4(light.cone_direction, light.cone_scale);
            shared_cone_offset[slot] = light.cone_offset;
        }
        if (hasLight(kLightShadows)) {
            shared_shadow[slot] = light.shadow;
        }
        subgroupMemoryBarrierShared();
        subgroupBarrier();
    }
}

LocalLight takeLight(LocalLight mine, uint invocation) {
    if (kSoftwareSubgroup) {
        return shuffleLight(mine, invocation);
    }
    uint slot = gl_SubgroupID * BATCH_SIZE + invocation;
    LocalLight light = darkLight();
    light.position_view = shared_reach[slot].xyz;
    light.inv_radius2 = hasLight(kLightEqualRadii) ? frame.light_inv_radius2 : shared_reach[slot].w;
    light.color = shared_color[slot];
    if (hasLight(kLightSpots)) {
        light.cone_direction = shared_cone[slot].xyz;
        light.cone_scale = shared_cone[slot].w;
        light.cone_offset = shared_cone_offset[slot];
    }
    if (hasLight(kLightShadows)) {
        light.shadow = shared_shadow[slot];
    }
    return light;
}

// Before the next ones are offered.
void takenLights() {
    if (!kSoftwareSubgroup) {
        subgroupBarrier();
    }
}
#else
void offerLight(LocalLight light) {}
LocalLight takeLight(LocalLight mine, uint invocation) { return shuffleLight(mine, invocation); }
void takenLights() {}
#endif

struct Block {
    vec3 low_view;
    vec3 high_view;
    vec3 centre_view;
    vec3 normal_view; // not unit
    float turn;       // farthest that a pixel's normal is from that
    float ahead;      // greatest normal . (centre - position), and the margin
    float reach2;     // of equal radii: (theirs + the block's)^2
    float slack;      // of equal radii: what `turn` and `ahead` come to within reach
};

// Of the invocations for which `mine` holds; at least one.
Block makeBlock(Surface s, bool mine) {
    const vec3 kNone = vec3(-1e30);
    Block b;
    b.high_view = largestOfBlock(mine ? s.position_view : kNone);
    b.low_view = -largestOfBlock(mine ? -s.position_view : kNone);
    b.centre_view = 0.5 * (b.low_view + b.high_view);
    vec3 normal_high = largestOfBlock(mine ? highestNormal(s) : kNone);
    vec3 normal_low = -largestOfBlock(mine ? -lowestNormal(s) : kNone);
    b.normal_view = 0.5 * (normal_low + normal_high);
    vec3 turn = s.normal_view - b.normal_view;
    vec3 from_centre = s.position_view - b.centre_view;
    vec3 own =
        vec3(dot(turn, turn), -dot(s.normal_view, from_centre), dot(from_centre, from_centre));
    own = largestOfLayers(own, s, b.normal_view, from_centre);
    vec3 worst = largestOfBlock(mine ? own : kNone);
    // A product of three terms is off by less than 1e-6 of its terms' sizes, here and in a pixel.
    vec3 size = b.high_view - b.low_view;
    b.turn = sqrt(worst.x) * 1.0001 + 1e-5;
    b.ahead = worst.y + 1e-5 * (size.x + size.y + size.z);
    // 1e15 m: farther than any light is
    float radius = inversesqrt(max(frame.light_inv_radius2, 1e-32));
    float reach = (radius + sqrt(worst.z)) * 1.0001;
    b.reach2 = reach * reach;
    b.slack = b.turn * reach + b.ahead;
    return b;
}

// Whether a light may add anything to a surface of the block.
bool mayLight(Block b, LocalLight light) {
    // normal . (light - position) = normal . (light - centre) + normal . (centre - position)
    vec3 to_light = light.position_view - b.centre_view;
    float facing = dot(b.normal_view, to_light);
    bool in_reach;
    if (hasLight(kLightEqualRadii)) {
        in_reach = dot(to_light, to_light) < b.reach2;
        facing += b.slack;
    } else {
        vec3 away =
            max(max(b.low_view - light.position_view, light.position_view - b.high_view), 0.0);
        precise float d2 = fma(away.z, away.z, fma(away.y, away.y, away.x * away.x));
        precise float x = d2 * light.inv_radius2;
        in_reach = x < 1.0;
        facing += b.turn * sqrt(dot(to_light, to_light)) + b.ahead;
    }
    // A ramp may lift what faces away.
    return in_reach && (hasLight(kLightToon) || facing > 0.0);
}

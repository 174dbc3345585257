// One light out of the frame's buffers, and what it adds to a surface.
#include "interface/area_io.h"
#include "lib/brdf.glsl"
#include "lib/shadow.glsl"

// A light as it is fetched; a point light's cone lets everything through: 0 * x + 1.
struct LocalLight {
    vec3 position_view;
    float inv_radius2;
    vec3 color;
    vec3 cone_direction;
    float cone_scale;
    float cone_offset;
    uint shadow; // kNoShadow: none
};

LocalLight darkLight() {
    return LocalLight(vec3(0.0), 0.0, vec3(0.0), vec3(0.0), 0.0, 1.0, kNoShadow);
}

// Where it is and how far it reaches.
LocalLight fetchReach(uint index) {
    vec4 a = texelFetch(light_texels, int(2u * index));
    LocalLight light = darkLight();
    light.position_view = a.xyz;
    light.inv_radius2 = hasLight(kLightEqualRadii) ? frame.light_inv_radius2 : a.w;
    return light;
}

// The rest.
void fetchColor(uint index, inout LocalLight light) {
    vec4 b = texelFetch(light_texels, int(2u * index + 1u));
    light.color = b.xyz;
    if (hasLight(kLightSpots)) {
        uint spot = floatBitsToUint(b.w);
        if (spot != kNoSpot) {
            vec4 c = texelFetch(spot_texels, int(2u * spot));
            light.cone_direction = c.xyz;
            light.cone_scale = c.w;
            vec4 d = texelFetch(spot_texels, int(2u * spot + 1u));
            light.cone_offset = d.x;
            if (hasLight(kLightAreas) && floatBitsToUint(d.y) != kNoArea) {
                light.color = vec3(0.0); // lib/area_loop.glsl adds it
            }
        }
    }
    if (hasLight(kLightShadows)) {
        light.shadow = texelFetch(shadow_of_light, int(index)).x;
    }
}

LocalLight fetchLight(uint index) {
    LocalLight light = fetchReach(index);
    fetchColor(index, light);
    return light;
}

ClusterList fetchList(uint cluster) {
    uvec2 list = texelFetch(list_texels, int(cluster)).xy;
    return ClusterList(list.x, list.y);
}

uint fetchIndex(uint entry) { return texelFetch(index_texels, int(entry)).x; }

// A spot's angular falloff towards a point; 1 for a point light.
float coneShare(LocalLight light, vec3 to_light) {
    precise float inv_d = inversesqrt(max(dot(to_light, to_light), kLeastDistance2));
    precise float towards = -dot(light.cone_direction, to_light) * inv_d;
    precise float f = clamp(fma(towards, light.cone_scale, light.cone_offset), 0.0, 1.0);
    return f * f;
}

// share: 1, or 0 where the light is not this invocation's.
void addLocalLight(Surface s, LocalLight light, float share, inout LightSum sum) {
    vec3 to_light = light.position_view - s.position_view;
    if (hasLight(kLightSpots)) {
        share *= coneShare(light, to_light);
    }
    float whole = share;
    if (hasLight(kLightShadows)) {
        precise float seen = whole * shadowShare(s, light.shadow);
        share = seen;
    }
    addLight(s, to_light, light.inv_radius2, light.color, share, sum);
    addToLayers(s, sum,
                addLight(layer, to_light, light.inv_radius2, light.color,
                         shareOnLayer(layer, light.shadow, whole, share), of_layer));
}

#ifdef FROXEL_SUBGROUPS
// The light that another invocation of the subgroup holds.
LocalLight shuffleLight(LocalLight mine, uint invocation) {
    LocalLight light = darkLight();
    light.position_view = subgroupShuffle(mine.position_view, invocation);
    light.inv_radius2 = hasLight(kLightEqualRadii) ? frame.light_inv_radius2
                                                   : subgroupShuffle(mine.inv_radius2, invocation);
    light.color = subgroupShuffle(mine.color, invocation);
    if (hasLight(kLightSpots)) {
        light.cone_direction = subgroupShuffle(mine.cone_direction, invocation);
        light.cone_scale = subgroupShuffle(mine.cone_scale, invocation);
        light.cone_offset = subgroupShuffle(mine.cone_offset, invocation);
    }
    if (hasLight(kLightShadows)) {
        light.shadow = subgroupShuffle(mine.shadow, invocation);
    }
    return light;
}
#endif

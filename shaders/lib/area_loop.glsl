// The rectangles among the lights of a list. Apart from the loop over the others: their code within
// it, though a constant turns it off, cost frames without any a tenth of their lighting on an H200.
// They are placed, so they come last: lists are walked from their ends.
#include "lib/area.glsl"

// kNoArea: the light is a point or a spot.
uint areaOf(uint index) {
    uint spot = floatBitsToUint(texelFetch(light_texels, int(2u * index + 1u)).w);
    return spot == kNoSpot ? kNoArea
                           : floatBitsToUint(texelFetch(spot_texels, int(2u * spot + 1u)).y);
}

LocalLight fetchWhole(uint index) {
    LocalLight light = fetchLight(index);
    light.color = texelFetch(light_texels, int(2u * index + 1u)).xyz;
    return light;
}

ClusterList wholeList(bool all_lights, uint cluster) {
    ClusterList list = ClusterList(0u, frame.light_count);
    if (!all_lights) {
        list = fetchList(cluster);
    }
    return list;
}

void addAreas(Surface s, bool all_lights, uint cluster, inout LightSum sum) {
    ClusterList list = wholeList(all_lights, cluster);
    for (uint left = list.count; left > 0u; --left) {
        uint index = all_lights ? left - 1u : fetchIndex(list.offset + left - 1u);
        if (index < frame.first_area) {
            break;
        }
        uint area = areaOf(index);
        if (area != kNoArea) {
            LocalLight light = fetchWhole(index);
            vec3 to_light = light.position_view - s.position_view;
            addAreaLight(s, fetchArea(area), to_light, light.inv_radius2, light.color,
                         coneShare(light, to_light), sum);
        }
    }
}

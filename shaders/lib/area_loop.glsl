// The rectangles among the lights of a list. Apart from the loop over the others: their code within
// it, though a constant turns it off, cost frames without any a tenth of their lighting on an H200.
// They are placed, so most come last: lists are walked from their ends to the first of the frame.
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

// The next rectangle of a list, from its end; `left`: how many lights are still to be looked at.
// False: there is none.
bool nextArea(ClusterList list, bool all_lights, inout uint left, out LocalLight light,
              out AreaRect rect) {
    light = darkLight();
    rect = AreaRect(vec3(0.0), vec3(0.0), 0.0);
    while (left > 0u) {
        --left;
        uint index = all_lights ? left : fetchIndex(list.offset + left);
        if (index < frame.first_area) {
            left = 0u;
            return false;
        }
        uint area = areaOf(index);
        if (area != kNoArea) {
            light = fetchWhole(index);
            rect = fetchArea(area);
            return true;
        }
    }
    return false;
}

void addAreas(Surface s, bool all_lights, uint cluster, inout LightSum sum) {
    ClusterList list = ClusterList(0u, frame.light_count);
    if (!all_lights) {
        list = fetchList(cluster);
    }
    uint left = list.count;
    LocalLight light;
    AreaRect rect;
    while (nextArea(list, all_lights, left, light, rect)) {
        vec3 to_light = light.position_view - s.position_view;
        addAreaLight(s, rect, to_light, light.inv_radius2, light.color, coneShare(light, to_light),
                     sum);
        addToLayers(s, sum,
                    addAreaLight(layer, rect, to_light, light.inv_radius2, light.color,
                                 coneShare(light, to_light), of_layer));
    }
}

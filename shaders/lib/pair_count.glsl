// Which lights a pixel is handed, and how many of them reach it.

// Within radius and cone; facing is not asked for.
bool reaches(LocalLight light, vec3 position) {
    vec3 to_light = light.position_view - position;
    float x = dot(to_light, to_light) * light.inv_radius2;
    return x < 1.0 && (!hasLight(kLightSpots) || coneShare(light, to_light) > 0.0);
}

// Its cluster's list, or all lights.
ClusterList handedList(uvec2 pixel, float distance) {
    if (!hasLight(kLightLists)) {
        return ClusterList(0u, frame.light_count);
    }
    uint cluster = clusterAt(pixel, distance);
    ClusterList list = ClusterList(0u, 0u);
    if (cluster != kNoCluster) {
        list = fetchList(cluster);
    }
    return list;
}

uint countReaching(ClusterList list, vec3 position) {
    uint reaching = 0;
    for (uint first = 0; first < list.count; first += kPlainStep) {
        [[unroll]] for (uint k = 0; k < kPlainStep; ++k) {
            uint i = first + k;
            if (kPlainStep == 1 || i < list.count) {
                uint index = hasLight(kLightLists) ? fetchIndex(list.offset + i) : i;
                reaching += reaches(fetchLight(index), position) ? 1u : 0u;
            }
        }
    }
    return reaching;
}

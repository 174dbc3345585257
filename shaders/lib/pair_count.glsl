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

// Loads past a list's end take its last light, so that none waits for a test.
uint countReaching(ClusterList list, vec3 position) {
    uint reaching = 0;
    for (uint first = 0; first < list.count; first += kPlainStep) {
        [[unroll]] for (uint k = 0; k < kPlainStep; ++k) {
            uint i = kPlainStep == 1 ? first : min(first + k, list.count - 1u);
            uint index = hasLight(kLightLists) ? fetchIndex(list.offset + i) : i;
            bool reached = reaches(fetchLight(index), position);
            reaching += reached && i == first + k ? 1u : 0u;
        }
    }
    return reaching;
}

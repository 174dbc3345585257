// The radiance from around, over directions. The cube's levels are filtered here, in fp32: a
// device's filter has weights of 8 bits, and llvmpipe takes one level of detail for four fragments.
#include "interface/environment_io.h"
#include "interface/frame_bindings.h"

layout(set = 0, binding = kEnvironmentBinding, scalar) uniform EnvironmentBlock {
    Environment environment;
};
layout(set = 0,
       binding = kLevelsBinding) uniform textureBuffer environment_texels; // environmentTexel()

// Irradiance over pi; n in the panorama's axes.
vec3 mattRadiance(vec3 n) {
    precise vec3 sum =
        environment.matt[0] + environment.matt[1] * n.z + environment.matt[2] * n.y +
        environment.matt[3] * n.x + environment.matt[4] * (n.x * n.z) +
        environment.matt[5] * (n.y * n.z) + environment.matt[6] * fma(3.0 * n.y, n.y, -1.0) +
        environment.matt[7] * (n.x * n.y) + environment.matt[8] * (n.z * n.z - n.x * n.x);
    return max(sum, 0.0);
}

// A face of the cube, and a place on it, 0 to 1 to the right and down.
struct CubePlace {
    uint face;
    vec2 at;
};

// Of a direction of any length.
CubePlace cubePlace(vec3 d) {
    vec3 size = abs(d);
    bool on_z = size.z >= max(size.x, size.y);
    bool on_y = !on_z && size.y >= size.x;
    float major = on_z ? d.z : on_y ? d.y : d.x;
    float side = major < 0.0 ? -1.0 : 1.0;
    vec2 at = on_z   ? vec2(side * d.x, -d.y)
              : on_y ? vec2(d.x, side * d.z)
                     : vec2(-side * d.z, -d.y);
    precise vec2 place = fma(at / abs(major), vec2(0.5), vec2(0.5));
    return CubePlace((on_z ? 4u : on_y ? 2u : 0u) + (major < 0.0 ? 1u : 0u), place);
}

vec3 levelAt(CubePlace place, uint level) {
    uint size = kEnvironmentSize >> level;
    uint side = size + 2u; // with the neighbours' texels
    precise vec2 at = fma(place.at, vec2(size), vec2(0.5));
    uvec2 corner = min(uvec2(at), uvec2(size));
    precise vec2 share = at - vec2(corner);
    int first = int(environmentTexel(level) + (place.face * side + corner.y) * side + corner.x);
    int below = first + int(side);
    precise vec3 value = mix(mix(texelFetch(environment_texels, first).rgb,
                                 texelFetch(environment_texels, first + 1).rgb, share.x),
                             mix(texelFetch(environment_texels, below).rgb,
                                 texelFetch(environment_texels, below + 1).rgb, share.x),
                             share.y);
    return value;
}

// The mean over a lobe about a direction in view space: environment::levelOf().
vec3 glossyRadiance(vec3 direction_view, float alpha) {
    const float kLast = float(1u << (kEnvironmentLevels - 2u)); // of alpha over the second level's
    float step = min(alpha * kLast, kLast);
    precise float level = step < 1.0 ? step : 1.0 + log2(step);
    uint finer = min(uint(level), kEnvironmentLevels - 2u);
    precise vec3 direction = environment.map_from_view * direction_view;
    CubePlace place = cubePlace(direction);
    precise vec3 radiance =
        mix(levelAt(place, finer), levelAt(place, finer + 1u), level - float(finer));
    return radiance * environment.strength;
}

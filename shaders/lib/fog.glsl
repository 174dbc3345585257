// The medium between the eye and what it sees: extinction and light from all around in closed form,
// light from lamps out of the froxel volume.
#include "interface/fog_io.h"
#include "interface/frame_bindings.h"

layout(set = 0, binding = kFogBinding, scalar) uniform FogBlock { Fog fog; };
// What it scatters: filled by fog_scatter.comp, added up by fog_integrate.comp.
layout(set = 0, binding = kFogVolumeBinding) uniform textureBuffer fog_texels;

const float kFogFarthest_m = 1e9; // stands for an empty pixel's distance

// (1 - exp(-x)) / x for x >= 0, to 1e-6 of it.
float meanTransmittance(float x) {
    precise float series =
        fma(x, fma(x, fma(x, fma(x, 1.0 / 120.0, -1.0 / 24.0), 1.0 / 6.0), -0.5), 1.0);
    precise float closed = (1.0 - exp(-x)) / max(x, 0.1);
    return x < 0.1 ? series : closed;
}

// Extinction times length from one point to another. The density over a stretch is the mean of what
// lies below the base height, where it is whole, and of an exponential above it.
float opticalDepth(vec3 from_view, vec3 to_view) {
    precise float length_m = distance(from_view, to_view);
    precise float from_m = fog.eye_height_m + dot(frame.up_view, from_view);
    precise float to_m = fog.eye_height_m + dot(frame.up_view, to_view);
    float low = min(from_m, to_m);
    float high = max(from_m, to_m);
    precise float least = max(low, 0.0);
    precise float above = max(high, 0.0) - least;
    precise float span = high - low;
    precise float thinned =
        exp(-fog.height_falloff * least) * meanTransmittance(fog.height_falloff * above);
    // Of a level stretch all is above, or nothing.
    float share_above = span > 0.0 ? above / span : (low > 0.0 ? 1.0 : 0.0);
    precise float mean = fma(share_above, thinned - 1.0, 1.0);
    return fog.density * length_m * (share_above >= 1.0 ? thinned : mean);
}

// Share of light that is lost over an optical depth: 1 - exp(-depth).
float lostOver(float depth) { return depth * meanTransmittance(depth); }

// Henyey and Greenstein 1941: the share of light a steradian that turns by an angle of this cosine.
float phase(float cosine) {
    float g = fog.anisotropy;
    precise float t = fma(-2.0 * g, cosine, fma(g, g, 1.0));
    precise float inverse = inversesqrt(t);
    return (1.0 - g * g) * (inverse * inverse * inverse) * 0.0795774715; // 1 / (4 pi)
}

// Where slice k of the volume begins.
float fogPlane(uint k) {
    precise float share = float(k) / float(fog.slice_count);
    return fog.far_m * (share * share);
}

// The pixel that a node stands at: the last ones at the picture's border.
uvec2 nodePixel(uvec2 node) {
    return min(node * fog.tile_px, uvec2(frame.camera.width_px, frame.camera.height_px) - 1u);
}

uint fogTexelOf(uvec3 node) {
    return (node.z * fog.node_count_y + node.y) * fog.node_count_x + node.x;
}

// Up to the beginning of slice k.
vec3 scatteredBefore(uvec2 node, uint k) {
    if (k == 0u) {
        return vec3(0.0);
    }
    return texelFetch(fog_texels, int(fogTexelOf(uvec3(node, k - 1u)))).rgb;
}

// Of lights, up to a distance: linear across and down, in depth by how much of the slice's
// scattering lies before that distance.
vec3 scatteredLights(uvec2 pixel, float distance) {
    float until = min(distance, fog.far_m);
    uint slice = min(uint(sqrt(until / fog.far_m) * float(fog.slice_count)), fog.slice_count - 1u);
    vec3 front = positionFromDistance(pixel, fogPlane(slice));
    float all = opticalDepth(front, positionFromDistance(pixel, fogPlane(slice + 1u)));
    float part = opticalDepth(front, positionFromDistance(pixel, max(until, fogPlane(slice))));
    float in_slice = all > 0.0 ? clamp(lostOver(part) / lostOver(all), 0.0, 1.0) : 0.0;
    uvec2 last = uvec2(fog.node_count_x, fog.node_count_y) - 2u;
    uvec2 node = min(pixel / fog.tile_px, last);
    vec2 low = vec2(nodePixel(node));
    vec2 share = (vec2(pixel) - low) / (vec2(nodePixel(node + 1u)) - low);
    vec3 planes[2];
    for (uint k = 0; k < 2; ++k) {
        vec3 top = mix(scatteredBefore(node, slice + k),
                       scatteredBefore(node + uvec2(1, 0), slice + k), share.x);
        vec3 bottom = mix(scatteredBefore(node + uvec2(0, 1), slice + k),
                          scatteredBefore(node + uvec2(1, 1), slice + k), share.x);
        planes[k] = mix(top, bottom, share.y);
    }
    return mix(planes[0], planes[1], in_slice);
}

// What the medium before a distance adds, and, as alpha, the share of light that it lets pass. What
// comes from all around and from suns is the same along a ray, so its integral is exact: source *
// (1 - transmittance).
vec4 fogBefore(uvec2 pixel, float distance) {
    vec3 eye = positionFromDistance(pixel, 0.0);
    vec3 point = positionFromDistance(pixel, distance);
    float depth = opticalDepth(eye, point);
    vec3 source = fog.ambient;
    if (hasLight(kLightDirectional)) {
        vec3 away = normalize(point - eye);
        for (uint i = 0; i < frame.directional_count; ++i) {
            source += min(suns[i].color * phase(-dot(suns[i].direction_view, away)), vec3(1e30));
        }
    }
    vec3 scattered = min(fog.albedo * source * lostOver(depth), vec3(1e30));
    if (hasOutput(kOutputFogVolume)) {
        scattered += scatteredLights(pixel, distance);
    }
    return vec4(scattered, exp(-depth));
}

// Of a surface whose own pixels no fog was laid over; a blended one brings as much as it covers.
vec3 throughFog(vec3 lit, uvec2 pixel, float distance) {
    if (hasOutput(kOutputFog)) {
        vec4 medium = fogBefore(pixel, distance);
        lit = fma(lit, vec3(medium.a), medium.rgb);
    }
    return lit;
}

// What throughFog() will lay over it taken off first.
vec3 withoutFog(vec3 seen, uvec2 pixel, float distance) {
    if (hasOutput(kOutputFog)) {
        vec4 medium = fogBefore(pixel, distance);
        seen = max(seen - medium.rgb, vec3(0.0)) / max(medium.a, 1e-6);
    }
    return seen;
}

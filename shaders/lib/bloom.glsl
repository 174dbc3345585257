// Bloom moves a share of each pixel's bright part to the pixels around it: picture + strength *
// (spread - bright). Every kind's weights add up to 1 for a pixel that gathers, and, with the
// picture mirrored at its borders, for one that gives too: a constant picture stays as it is, and
// light is moved, neither lost nor made, however many pixels it comes from.
#include "interface/bloom_io.h"
#include "interface/constants.h"
#include "interface/frame_io.h"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;
layout(constant_id = 2) const uint BLOOM_FLAGS = 0;
layout(set = 0, binding = 0) uniform texture2D source_image;
layout(set = 0, binding = 1, rgba32f) uniform image2D target_image;
layout(set = 1, binding = 0, scalar) uniform FrameBlock { Frame frame; };
layout(push_constant, scalar) uniform PassBlock { BloomPass bloom; };

// Infinity would spread over the picture and become no number.
const vec3 kMostBright = vec3(1e30);

// An exposure that the frame meters is known on the device alone.
float inRadiance(float level) {
    return (BLOOM_FLAGS & kBloomMetered) != 0 ? level / frame.exposure : level;
}

// The part of it that is above the threshold; from knee below to knee above it sets in as a
// parabola.
vec3 brightPart(vec3 radiance) {
    float threshold = inRadiance(bloom.threshold);
    float knee = inRadiance(bloom.knee);
    vec3 color = min(radiance, kMostBright);
    float peak = max(color.r, max(color.g, color.b));
    float soft = clamp(peak - threshold + knee, 0.0, 2.0 * knee);
    soft = knee > 0.0 ? soft * soft / (4.0 * knee) : 0.0;
    float part = max(soft, peak - threshold);
    return peak > 0.0 ? color * (max(part, 0.0) / peak) : vec3(0.0);
}

// The plan keeps every reach below the picture's sides, so that once is enough.
ivec2 mirrored(ivec2 at) {
    ivec2 size = ivec2(bloom.source_width_px, bloom.source_height_px);
    at = mix(at, -1 - at, lessThan(at, ivec2(0)));
    return clamp(min(at, 2 * size - 1 - at), ivec2(0), size - 1);
}

// What is unlit has a colour of the display.
vec3 radianceOf(vec4 texel) { return texel.a > 1.0 ? texel.rgb / frame.exposure : texel.rgb; }

vec3 sourceAt(ivec2 at) {
    vec4 texel = texelFetch(source_image, mirrored(at), 0);
    return (BLOOM_FLAGS & kBloomBright) != 0 ? brightPart(radianceOf(texel)) : texel.rgb;
}

bool insideTarget() {
    return all(
        lessThan(gl_GlobalInvocationID.xy, uvec2(bloom.target_width_px, bloom.target_height_px)));
}

// `share`: of `spread`; the rest is what the target has, of the picture its bright part.
void put(ivec2 at, vec3 spread, float share) {
    bool adds = (BLOOM_FLAGS & kBloomAdds) != 0;
    if (!adds && share == 1.0) {
        imageStore(target_image, at, vec4(spread, 1.0));
        return;
    }
    vec4 before = imageLoad(target_image, at);
    if (!adds) {
        imageStore(target_image, at, vec4(mix(before.rgb, spread, share), 1.0));
        return;
    }
    vec3 own = brightPart(radianceOf(before));
    vec3 added = bloom.strength * (mix(own, spread, share) - own);
    if (before.a > 1.0) {
        added *= frame.exposure;
    }
    imageStore(target_image, at, vec4(before.rgb + added, before.a));
}

// Counts pixels by luminance: those of solid surfaces that are lit, without what is blended over
// them. Not the empty and the unlit ones, nor what is black (darker than any bin) or no number;
// what is brighter than any bin is of the last.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "interface/exposure_io.h"
#include "lib/frame.glsl"
#include "lib/tonemap.glsl"
#include "lib/screen.glsl"

layout(local_size_x = kScreenGroup, local_size_y = kScreenGroup) in;
layout(set = 2, binding = 0, scalar) buffer CountBlock { uint counts[kMeterBins]; };

const uint kInvocations = kScreenGroup * kScreenGroup;
const uint kInfinity = 0x7f800000u; // below the bits of NaN and of all that is negative

shared uint group_counts[kMeterBins];

void countPixel(ivec2 pixel) {
    vec4 radiance = imageLoad(radiance_image, pixel); // alpha: radianceAlpha()
    float depth = texelFetch(depth_image, pixel, 0).x;
    uint bits = floatBitsToUint(dot(radiance.rgb, vec3(0.2126, 0.7152, 0.0722))); // BT.709
    bool bright = bits >= kMeterFirst << kMeterBinShift && bits <= kInfinity;
    if (bright && depth > 0.0 && radiance.a == 1.0) {
        uint bin = min((bits >> kMeterBinShift) - kMeterFirst, kMeterBins - 1u);
        atomicAdd(group_counts[bin], 1u);
    }
}

void main() {
    for (uint i = gl_LocalInvocationIndex; i < kMeterBins; i += kInvocations) {
        group_counts[i] = 0u;
    }
    barrier();
    uvec2 first = gl_WorkGroupID.xy * (kScreenGroup * kMeterPixels) + gl_LocalInvocationID.xy;
    for (uint i = 0; i < kMeterPixels * kMeterPixels; ++i) {
        uvec2 pixel = first + kScreenGroup * uvec2(i % kMeterPixels, i / kMeterPixels);
        if (insideScreen(pixel)) {
            countPixel(ivec2(pixel));
        }
    }
    barrier();
    for (uint i = gl_LocalInvocationIndex; i < kMeterBins; i += kInvocations) {
        if (group_counts[i] > 0u) {
            atomicAdd(counts[i], group_counts[i]);
        }
    }
}

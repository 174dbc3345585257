// From the histogram to the exposure that this frame's later passes read: what was asked for, times
// what brings the geometric mean of the middle pixels' luminance to middle grey.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "interface/exposure_io.h"
#include "interface/frame_io.h"

const uint kInvocations = 64u;
layout(local_size_x = kInvocations) in;
layout(set = 2, binding = 0, scalar) readonly buffer CountBlock { uint counts[kMeterBins]; };
layout(set = 2, binding = 1, scalar) buffer FrameBlock { Frame frame; };

const float kMiddleGrey = 0.18;
const uint kDroppedPart = 10u; // of the pixels: a tenth at either end
const float kMost_ev = 10.0;   // up or down

shared uint bins[kMeterBins];

// Of a bin's geometric middle.
float log2Luminance(uint bin) {
    float lower = uintBitsToFloat((kMeterFirst + bin) << kMeterBinShift);
    float upper = uintBitsToFloat((kMeterFirst + bin + 1u) << kMeterBinShift);
    return 0.5 * log2(lower * upper);
}

// 1 where nothing was counted.
float meteredFactor() {
    uint total = 0u;
    for (uint bin = 0; bin < kMeterBins; ++bin) {
        total += bins[bin];
    }
    if (total == 0u) {
        return 1.0;
    }
    uint first = total / kDroppedPart;
    uint last = total - first;
    uint below = 0u; // pixels in the bins so far
    precise float mean = 0.0;
    for (uint bin = 0; bin < kMeterBins; ++bin) {
        uint from = clamp(below, first, last);
        below += bins[bin];
        uint to = clamp(below, first, last);
        mean += float(to - from) / float(last - first) * log2Luminance(bin);
    }
    return exp2(clamp(log2(kMiddleGrey) - mean, -kMost_ev, kMost_ev));
}

void main() {
    for (uint bin = gl_LocalInvocationIndex; bin < kMeterBins; bin += kInvocations) {
        bins[bin] = counts[bin];
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u) {
        frame.exposure *= meteredFactor();
    }
}

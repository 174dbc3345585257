// Lengths of light lists in log-linear buckets: exact below 16, then sixteen equal steps an octave.
// One formula for host and device, so that both report the same percentile.
#ifndef FROXEL_INTERFACE_HISTOGRAM_IO_H
#define FROXEL_INTERFACE_HISTOGRAM_IO_H

#include "compat.h"

#ifdef __cplusplus
#include <bit>
#define FROXEL_FUNCTION inline
#else
#define FROXEL_FUNCTION
#endif

FROXEL_IO_NAMESPACE_BEGIN

FROXEL_CONST uint kHistogramSteps = 16U;    // an octave
FROXEL_CONST uint kHistogramBuckets = 464U; // hold every 32-bit length

#ifdef __cplusplus
constexpr int findMSB(uint value) { return static_cast<int>(std::bit_width(value)) - 1; }
#endif

FROXEL_FUNCTION uint histogramBucket(uint length) {
    if (length < kHistogramSteps) {
        return length;
    }
    uint shift = uint(findMSB(length)) - 4U;
    return shift * kHistogramSteps + (length >> shift);
}

// The largest length of a bucket.
FROXEL_FUNCTION uint histogramUpper(uint bucket) {
    if (bucket < kHistogramSteps) {
        return bucket;
    }
    uint shift = bucket / kHistogramSteps - 1U;
    return ((bucket - shift * kHistogramSteps) << shift) + ((1U << shift) - 1U);
}

// How many of `count` lists the 95th percentile covers, rounded up; count below 2^25.
FROXEL_FUNCTION uint histogramRank95(uint count) { return (count * 95U + 99U) / 100U; }

FROXEL_IO_NAMESPACE_END

#endif

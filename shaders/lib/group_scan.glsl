// Prefix sums over a workgroup, whose size is declared before; all must call.
#include "interface/scan_io.h"

shared uint scan_words[gl_WorkGroupSize.x];

uint saturated(uint sum) { return min(sum, kScanSaturated); }

// The sum of the invocations before this one; `total` is that of all. Saturates, so values must not
// pass kScanSaturated.
uint scanGroup(uint value, out uint total) {
    uint self = gl_LocalInvocationIndex;
    barrier();
    scan_words[self] = value;
    for (uint step = 1u; step < gl_WorkGroupSize.x; step <<= 1u) {
        barrier();
        uint before = self >= step ? scan_words[self - step] : 0u;
        barrier();
        scan_words[self] = saturated(scan_words[self] + before);
    }
    barrier();
    total = scan_words[gl_WorkGroupSize.x - 1u];
    return self > 0u ? scan_words[self - 1u] : 0u;
}

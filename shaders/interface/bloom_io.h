// What one pass of bloom is told: shaders/lib/bloom.glsl, render/bloom_plan.h.
#ifndef FROXEL_INTERFACE_BLOOM_IO_H
#define FROXEL_INTERFACE_BLOOM_IO_H

#include "compat.h"

FROXEL_IO_NAMESPACE_BEGIN

// Of the output flags of bloom's own shaders.
FROXEL_CONST uint kBloomBright = 1U << 0;  // the source is the picture: its bright part is read
FROXEL_CONST uint kBloomAdds = 1U << 1;    // the target is the picture: what was spread moves in it
FROXEL_CONST uint kBloomMetered = 1U << 2; // threshold and knee are in exposed radiance

struct BloomPass {
    uint source_width_px;
    uint source_height_px;
    uint target_width_px;
    uint target_height_px;
    uint step_x_px; // from tap to tap
    uint step_y_px;
    uint reach;      // Gaussians: taps on either side
    float falloff;   // Gaussians: a tap k away weighs 2^(falloff k^2)
    float share;     // of this pass in its result; the rest is what the one before had
    float threshold; // radiance from which light is bright, and how far around it that sets in;
                     // kBloomMetered: exposed
    float knee;
    float strength; // share of the bright part that is spread
};
FROXEL_SIZE_ASSERT(BloomPass, 48);

FROXEL_IO_NAMESPACE_END

#endif

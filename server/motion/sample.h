// Values of a track between its keys.
#pragma once

#include "scene/motion.h"

#include <span>

namespace froxel::motion {

// The track's value at a time, into `out` of Track::width numbers, by the formulas of glTF 2.0,
// appendix C, in double. Before the first key and after the last the end value holds. Keys are
// found by bisection, so what was sampled before does not matter; of keys at one time the last
// counts. rotations: of width 4, along the shorter arc, always of length 1; keys of length 0 are no
// rotation.
void sample(const scene::Track& track, double time_s, bool rotations, std::span<double> out);

} // namespace froxel::motion

// FLIP: the difference that an observer sees when flipping between two pictures.
//
// Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astrom and Fairchild, "FLIP: A Difference
// Evaluator for Alternating Images", PACMCGIT 3(2), HPG 2020. Section and equation numbers are that
// paper's. Constants are the paper's, as in version 1.6 of the authors' code
// (github.com/NVlabs/flip); pictures repeat their border pixels. Computed in fp32, as theirs is.
// Any thread.
#pragma once

#include "image_metrics/filter.h"

#include <array>
#include <cstddef>

namespace froxel::image_metrics::flip {

// Linear RGB of sRGB primaries, 0..1 each.
using Rgb = std::array<float, 3>;
using RgbPlanes = std::array<Plane<float>, 3>;

// sRGB's transfer function, IEC 61966-2-1.
[[nodiscard]] float linearFromSrgb(float srgb);
[[nodiscard]] float srgbFromLinear(float linear);

// L*a*b* (D65) with a* and b* scaled by L*/100 for the Hunt effect.
[[nodiscard]] Rgb huntAdjustedLab(const Rgb& linear);
// |dL| + sqrt(da^2 + db^2) (Abasi et al. 2020).
[[nodiscard]] float hyab(const Rgb& lab_a, const Rgb& lab_b);
// A HyAB distance to an error in 0..1: raised to 0.7, then 0..0.4 of the largest (between green and
// blue) to 0..0.95, the rest to 0.95..1.
[[nodiscard]] float colourError(float hyab_distance);

// How many pixels away a pixel may be from one whose error depends on it.
[[nodiscard]] size_t reach(double pixels_per_degree);

// Each pixel's FLIP, 0..1. Same sizes, not empty, every value in 0..1.
[[nodiscard]] Plane<float>
errors(const RgbPlanes& picture, const RgbPlanes& reference, double pixels_per_degree);

} // namespace froxel::image_metrics::flip

// Structural similarity of two pictures.
#pragma once

#include "image_metrics/filter.h"

namespace froxel::image_metrics {

// Mean SSIM of two luma pictures in 0..255: Wang, Bovik, Sheikh and Simoncelli, "Image quality
// assessment: from error visibility to structural similarity", IEEE Trans. Image Processing 13(4),
// 2004, equation 13: 11x11 Gaussian of sigma 1.5, K1 0.01, K2 0.03, L 255, no downsampling, the
// mean over windows that lie inside the picture (as in the authors' ssim_index.m). A side below 11
// pixels is extended to 11 by repeating border pixels, so that there is a window. Same sizes, not
// empty; any thread.
[[nodiscard]] double meanStructuralSimilarity(const Plane<double>& a, const Plane<double>& b);

} // namespace froxel::image_metrics

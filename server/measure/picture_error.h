// How far a picture is from its reference, in numbers. Pure functions, any thread. Pictures of
// different sizes are a bug of the caller (FROXEL_ASSERT).
#pragma once

#include "core/linear_image.h"
#include "core/pixel_view.h"

#include <cstdint>

namespace froxel::measure {

// Over all channels of all pixels, in the unit of the pictures compared: linear radiance, or 1/255
// steps divided by 255. A picture with a non-finite value is counted in nonfinite_count, and such a
// pixel in nothing else.
struct DifferenceStats {
    double max_abs = 0;
    double p999_abs = 0;          // 99.9th percentile of the absolute difference
    double rmse = 0;              // sqrt(mean (a - b)^2)
    double relative_rmse = 0;     // sqrt(mean (a - b)^2 / (b^2 + 0.01)), b the reference
    double psnr_db = 0;           // 20 log10(peak / rmse); infinity where equal
    double peak = 1;              // of psnr_db
    uint64_t pixel_count = 0;
    uint64_t differing_count = 0; // pixels with any difference
    uint64_t nonfinite_count = 0; // pixels of either picture with a NaN or infinity
};

// What only the shown picture (sRGB, 8 bit) has.
struct PerceivedStats {
    uint64_t above_1_255_count = 0; // pixels with a channel more than 1/255 off
    double mssim = 1;               // Wang et al. 2004: 11x11 Gaussian, sigma 1.5, luma
    double flip = 0;                // mean LDR-FLIP (Andersson et al. 2020) at kPixelsPerDegree
};

// Tiles' borders against elsewhere: mean step of the error across vertical and horizontal borders of
// tiles over its mean step elsewhere. 1: tiles do not show; 0 where there is no error.
struct TileGrid {
    uint32_t width_px = 0;
    uint32_t height_px = 0;
};

inline constexpr double kPixelsPerDegree = 67; // 0.7 m from a 0.7 m wide screen of 3840 pixels

[[nodiscard]] DifferenceStats linearDifference(const LinearImage& picture,
                                               const LinearImage& reference);
[[nodiscard]] DifferenceStats shownDifference(const PixelView& picture, const PixelView& reference);
[[nodiscard]] PerceivedStats perceivedDifference(const PixelView& picture,
                                                 const PixelView& reference);
// Mean HDR-FLIP (Andersson et al. 2021); its exposures come from the reference.
[[nodiscard]] double hdrFlip(const LinearImage& picture, const LinearImage& reference);
[[nodiscard]] double
tileEdgeRatio(const LinearImage& picture, const LinearImage& reference, const TileGrid& tiles);

} // namespace froxel::measure

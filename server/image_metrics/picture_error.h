// How far a picture is from its reference, in numbers. Pure functions, any thread. Pictures of
// different sizes, empty pictures and tiles without a size are a bug of the caller (FROXEL_ASSERT).
#pragma once

#include "core/linear_image.h"
#include "core/pixel_view.h"
#include "image_metrics/filter.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace froxel::image_metrics {

// Over all channels of all pixels, in the unit of the pictures compared: linear radiance, or 1/255
// steps divided by 255. A pixel with a non-finite value in either picture is counted in pixel_count
// and nonfinite_count, and in nothing else; where no pixel is finite the errors are NaN.
struct DifferenceStats {
    double max_abs = 0;
    double p999_abs = 0;      // 99.9th percentile of the absolute difference, nearest rank
    double rmse = 0;          // sqrt(mean (a - b)^2)
    double relative_rmse = 0; // sqrt(mean (a - b)^2 / (b^2 + 0.01)), b the reference
    double psnr_db = std::numeric_limits<double>::infinity(); // 20 log10(peak / rmse)
    double peak = 1;                                          // of psnr_db
    uint64_t pixel_count = 0;
    uint64_t differing_count = 0; // pixels with any difference
    uint64_t nonfinite_count = 0;
};

// What only the shown picture (sRGB, 8 bit) has.
struct PerceivedStats {
    uint64_t above_1_255_count = 0; // pixels with a channel more than 1/255 off
    double mssim = 1;               // structural_similarity.h, on luma of ITU-R BT.601
    double flip = 0;                // mean LDR-FLIP (flip.h) at kPixelsPerDegree
};

// Pixels of a tile; the last column and row of tiles may be cut by the picture's border.
struct TileGrid {
    uint32_t width_px = 0;
    uint32_t height_px = 0;
};

// Of FLIP: 0.7 m from a 0.7 m wide screen of 3840 pixels has 67.0 pixels a degree (0.7 * 3840 / 0.7
// * pi / 180), as in the papers.
inline constexpr double kPixelsPerDegree = 67.020643276582250;

// `peak`: the radiance that is shown as white, for psnr_db.
[[nodiscard]] DifferenceStats
linearDifference(const LinearImage& picture, const LinearImage& reference, double peak = 1);
[[nodiscard]] DifferenceStats shownDifference(const PixelView& picture, const PixelView& reference);
[[nodiscard]] PerceivedStats perceivedDifference(const PixelView& picture,
                                                 const PixelView& reference);

// PerceivedStats::mssim alone.
[[nodiscard]] double structuralSimilarity(const PixelView& picture, const PixelView& reference);

// Each pixel's LDR-FLIP, 0..1, at kPixelsPerDegree; its mean is PerceivedStats::flip.
[[nodiscard]] Plane<float> flipErrors(const PixelView& picture, const PixelView& reference);

// Each pixel's HDR-FLIP, 0..1: Andersson, Nilsson, Shirley and Akenine-Moeller, "Visualizing Errors
// in Rendered High Dynamic Range Images", Eurographics 2021: the largest LDR-FLIP of each pixel
// over a range of exposures under the ACES curve (Narkowicz 2016). The reference's brightest and
// median luminance reach 0.85 at the first and the last exposure; a stop apart, at least two.
// Negative values count as 0. None where either picture has a non-finite value.
[[nodiscard]] std::optional<Plane<float>> hdrFlipErrors(const LinearImage& picture,
                                                        const LinearImage& reference);
// Their mean; NaN where there are none.
[[nodiscard]] double hdrFlip(const LinearImage& picture, const LinearImage& reference);

// A picture as HDR-FLIP shows it at the middle of the range of exposures that `reference` asks for.
// [height][width][4], alpha 255; NaN becomes 0.
[[nodiscard]] std::vector<std::byte> shownAsReference(const LinearImage& picture,
                                                      const LinearImage& reference);

[[nodiscard]] double meanOf(const Plane<float>& plane);

// The first pixel, row by row, with a channel that differs by more than `tolerance` or is not
// finite in one of the pictures.
struct PixelDifference {
    uint32_t x = 0;
    uint32_t y = 0;
    std::array<float, 3> picture{}; // in the unit of DifferenceStats
    std::array<float, 3> reference{};
};
struct Differing {
    uint64_t count = 0;
    std::optional<PixelDifference> first; // none: count is 0
};
// `tolerance` in linear radiance, of 8-bit pictures in 1/255 steps.
[[nodiscard]] Differing
differing(const LinearImage& picture, const LinearImage& reference, double tolerance);
[[nodiscard]] Differing
differing(const PixelView& picture, const PixelView& reference, uint32_t tolerance);

// Errors of 0..1 in the colours of interface/heat_map.h. [height][width][4], alpha 255.
[[nodiscard]] std::vector<std::byte> heatMap(const Plane<float>& errors);

// Do tiles show in the error? Mean absolute step of the error (picture - reference) between
// neighbours across borders of tiles, over its mean elsewhere. 0: no error; 1: borders do not stand
// out, or one of the two kinds does not exist; infinity: only borders have steps. Steps at
// non-finite pixels are left out.
[[nodiscard]] double
tileEdgeRatio(const LinearImage& picture, const LinearImage& reference, const TileGrid& tiles);

} // namespace froxel::image_metrics

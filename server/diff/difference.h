// How far two pictures are apart, and whether that is within limits. Pure functions, any thread.
#pragma once

#include "core/error.h"
#include "diff/picture.h"
#include "image_metrics/picture_error.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace froxel::diff {

// Of pictures, the second of which is the reference.
struct Difference {
    PictureSize size;
    bool radiance = false; // both are linear radiance, else display colours

    image_metrics::DifferenceStats values; // of radiance in its unit, of colours in 0..1
    // Mean LDR-FLIP, of radiance mean HDR-FLIP; NaN where a value is not finite.
    double flip = 0;
    // Mean structural similarity of luma, of radiance as HDR-FLIP shows it.
    double mssim = 1;
    // Beyond Limits::tolerance.
    image_metrics::Differing beyond;
    // Of each pixel, 0..1; empty where all pixels are equal, or a value is not finite.
    image_metrics::Plane<float> flip_errors;

    [[nodiscard]] bool equal() const {
        return values.differing_count + values.nonfinite_count == 0;
    }
};

// What a difference may be at most.
struct Limits {
    // Of a channel, above which a pixel differs: 1/255 steps of colours, or radiance.
    double tolerance = 0;
    std::optional<double> max_flip = {};
    std::optional<double> max_rmse = {};
    // The share of pixels that differ. Without any limit: 0.
    std::optional<double> max_differing = {};
};

// Errors: kInvalidArgument where the pictures have different sizes or are of different kinds.
[[nodiscard]] Result<Difference>
measure(const Picture& picture, const Picture& reference, double tolerance = 0);
// Of display colours.
[[nodiscard]] Difference
measure(const PixelView& picture, const PixelView& reference, double tolerance = 0);

// One line for each limit that is broken: "FLIP is 0.02, at most 0.01 is allowed". Radiance that is
// not finite breaks all of them.
[[nodiscard]] std::vector<std::string> broken(const Difference& difference, const Limits& limits);

// "equal, 230400 pixels compared", or the figures and the first pixel that differs.
[[nodiscard]] std::string wordsOf(const Difference& difference);

// As the eye gets it, of radiance as HDR-FLIP shows it for the reference.
[[nodiscard]] std::vector<std::byte> shownOf(const Picture& picture, const Picture& reference);

} // namespace froxel::diff

// A picture before exposure and tone map.
#pragma once

#include "core/pixel_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace froxel {

// Linear fp32 radiance: [height][width][3], top row first.
struct LinearImage {
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    std::vector<float> rgb;
    // Metres along the view axis, infinity where there is no solid surface: [height][width].
    std::vector<float> depth_m = {}; // empty: unknown
};

// Of each pixel the nearest of its samples' depths; empty: the picture has none.
[[nodiscard]] inline std::vector<float> depthOf(const PixelView& picture) {
    const float* depth = picture.output(Output::kDepth);
    std::vector<float> nearest;
    if (depth == nullptr) {
        return nearest;
    }
    const size_t samples = picture.output_samples;
    const size_t row = samples * picture.width_px;
    nearest.assign(size_t{picture.width_px} * picture.height_px,
                   std::numeric_limits<float>::infinity());
    for (size_t y = 0; y < samples * picture.height_px; ++y) {
        for (size_t x = 0; x < row; ++x) {
            float& of_pixel = nearest[y / samples * picture.width_px + x / samples];
            of_pixel = std::min(of_pixel, depth[y * row + x]);
        }
    }
    return nearest;
}

// A copy of the picture's radiance, which it has: of each pixel the mean of its samples. With its
// depth, if it has that, too.
[[nodiscard]] inline LinearImage radianceOf(const PixelView& picture) {
    const size_t samples = picture.output_samples;
    const float share = 1.0F / static_cast<float>(samples * samples);
    const size_t row_floats = samples * picture.width_px * 4;
    const float* radiance = picture.output(Output::kRadiance);
    LinearImage image{picture.width_px, picture.height_px, {}, depthOf(picture)};
    image.rgb.reserve(size_t{picture.width_px} * picture.height_px * 3);
    for (size_t y = 0; y < picture.height_px; ++y) {
        for (size_t x = 0; x < picture.width_px; ++x) {
            const float* first = radiance + samples * (y * row_floats + x * 4);
            for (size_t channel = 0; channel < 3; ++channel) {
                float sum = 0;
                for (size_t sample = 0; sample < samples * samples; ++sample) {
                    sum += first[sample / samples * row_floats + sample % samples * 4 + channel];
                }
                image.rgb.push_back(share * sum);
            }
        }
    }
    return image;
}

// Adds a share of a picture to others of its size, or to none.
inline void addTo(LinearImage& sum, const LinearImage& picture, float share) {
    sum.width_px = picture.width_px;
    sum.height_px = picture.height_px;
    sum.rgb.resize(picture.rgb.size());
    std::transform(sum.rgb.begin(), sum.rgb.end(), picture.rgb.begin(), sum.rgb.begin(),
                   [share](float a, float b) { return std::fma(b, share, a); });
    // A mean of depths is that of nothing: the nearest.
    sum.depth_m.resize(picture.depth_m.size(), std::numeric_limits<float>::infinity());
    std::transform(sum.depth_m.begin(), sum.depth_m.end(), picture.depth_m.begin(),
                   sum.depth_m.begin(), [](float a, float b) { return std::min(a, b); });
}

} // namespace froxel

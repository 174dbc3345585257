// A picture before exposure and tone map.
#pragma once

#include "core/pixel_view.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace froxel {

// Linear fp32 radiance: [height][width][3], top row first.
struct LinearImage {
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    std::vector<float> rgb;
};

// A copy of the picture's radiance, which it has: of each pixel the mean of its samples.
[[nodiscard]] inline LinearImage radianceOf(const PixelView& picture) {
    const size_t samples = picture.output_samples;
    const float share = 1.0F / static_cast<float>(samples * samples);
    const size_t row_floats = samples * picture.width_px * 4;
    const float* radiance = picture.output(Output::kRadiance);
    LinearImage image{picture.width_px, picture.height_px, {}};
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
}

} // namespace froxel

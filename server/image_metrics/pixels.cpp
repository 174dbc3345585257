#include "image_metrics/pixels.h"

#include "core/assert.h"

#include <algorithm>
#include <cmath>

namespace froxel::image_metrics {

void expectAlike(const LinearImage& picture, const LinearImage& reference) {
    FROXEL_ASSERT(picture.width_px == reference.width_px &&
                      picture.height_px == reference.height_px,
                  "pictures of one size");
    const size_t value_count = size_t{3} * picture.width_px * picture.height_px;
    FROXEL_ASSERT(value_count > 0 && picture.rgb.size() == value_count &&
                      reference.rgb.size() == value_count,
                  "pictures have pixels");
}

void expectAlike(const PixelView& picture, const PixelView& reference) {
    FROXEL_ASSERT(picture.width_px == reference.width_px &&
                      picture.height_px == reference.height_px,
                  "pictures of one size");
    FROXEL_ASSERT(picture.data != nullptr && reference.data != nullptr && picture.width_px > 0 &&
                      picture.height_px > 0,
                  "pictures have pixels");
}

bool isFinite(const Pixel& pixel) {
    return std::all_of(pixel.begin(), pixel.end(),
                       [](float value) { return std::isfinite(value); });
}

} // namespace froxel::image_metrics

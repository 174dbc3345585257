// How this layer reads the two kinds of pictures.
#pragma once

#include "core/linear_image.h"
#include "core/pixel_view.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace froxel::image_metrics {

using Pixel = std::array<float, 3>;

// FROXEL_ASSERT: same size, not empty.
void expectAlike(const LinearImage& picture, const LinearImage& reference);
void expectAlike(const PixelView& picture, const PixelView& reference);

[[nodiscard]] bool isFinite(const Pixel& pixel);

// i: y * width + x.
[[nodiscard]] inline Pixel pixelAt(const LinearImage& image, size_t i) {
    return {image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2]};
}

// The bytes of a pixel's red, green and blue.
[[nodiscard]] inline std::array<uint8_t, 3> bytesAt(const PixelView& view, uint32_t x, uint32_t y) {
    const std::byte* pixel = view.data + y * view.stride_bytes + size_t{4} * x;
    return {std::to_integer<uint8_t>(pixel[0]), std::to_integer<uint8_t>(pixel[1]),
            std::to_integer<uint8_t>(pixel[2])};
}

} // namespace froxel::image_metrics

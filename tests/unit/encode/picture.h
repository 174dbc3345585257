// Synthetic pictures for the encoder's tests.
#pragma once

#include "core/pixel_view.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace froxel::encode {

struct Picture {
    uint32_t width_px = 0;
    uint32_t height_px = 0;
    size_t stride_bytes = 0;
    std::vector<std::byte> bytes;
    std::vector<float> radiance = {}; // RGBA; empty: none
    uint32_t radiance_samples = 1;
    std::vector<float> depth_m = {}; // of each sample; empty: none

    [[nodiscard]] PixelView view() const {
        return {.data = bytes.data(),
                .width_px = width_px,
                .height_px = height_px,
                .stride_bytes = stride_bytes,
                .outputs = {radiance.empty() ? nullptr : radiance.data(),
                            depth_m.empty() ? nullptr : depth_m.data()},
                .output_samples = radiance_samples};
    }
    [[nodiscard]] int channel(uint32_t x, uint32_t y, uint32_t c) const {
        return std::to_integer<int>(bytes[y * stride_bytes + x * 4 + c]);
    }
};

// Smooth gradients with a coloured pattern, so that chroma subsampling and quality both show.
// Bytes of the padding are 0xEE: an encoder that reads them makes wrong pictures.
inline Picture makePicture(uint32_t width_px, uint32_t height_px, size_t padding_bytes = 0) {
    Picture picture{width_px, height_px, width_px * size_t{4} + padding_bytes, {}};
    picture.bytes.assign(picture.stride_bytes * height_px, std::byte{0xEE});
    for (uint32_t y = 0; y < height_px; ++y) {
        for (uint32_t x = 0; x < width_px; ++x) {
            std::byte* pixel = &picture.bytes[y * picture.stride_bytes + x * 4];
            const double wave = 0.5 + 0.5 * std::sin(0.35 * x) * std::cos(0.27 * y);
            pixel[0] = static_cast<std::byte>(255 * wave);
            pixel[1] = static_cast<std::byte>((x * 3 + y) & 0xFFU);
            pixel[2] = static_cast<std::byte>(255 * (1 - wave));
            pixel[3] = std::byte{255};
        }
    }
    return picture;
}

// With so many samples across a pixel, each value its own; also what 8 bits and halves cannot hold.
inline Picture makeRadiance(uint32_t width_px, uint32_t height_px, uint32_t samples) {
    Picture picture = makePicture(width_px, height_px);
    picture.radiance_samples = samples;
    picture.radiance.resize(size_t{width_px} * height_px * samples * samples * 4);
    for (size_t i = 0; i < picture.radiance.size(); ++i) {
        picture.radiance[i] =
            std::ldexp(1.0F + 0.001F * static_cast<float>(i), static_cast<int>(i % 40) - 20);
    }
    return picture;
}

} // namespace froxel::encode

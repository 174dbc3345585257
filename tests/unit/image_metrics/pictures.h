// Small pictures for the metrics' tests.
#pragma once

#include "core/linear_image.h"
#include "core/pixel_view.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace froxel::image_metrics {

using Bytes = std::array<uint8_t, 3>;

// An RGBA8 picture that owns its bytes; rows are `padding_bytes` longer than their pixels.
struct ShownPicture {
    uint32_t width_px;
    uint32_t height_px;
    size_t stride_bytes;
    std::vector<std::byte> bytes;

    ShownPicture(uint32_t width, uint32_t height, Bytes colour, size_t padding_bytes = 0)
        : width_px(width), height_px(height), stride_bytes(size_t{4} * width + padding_bytes),
          bytes(stride_bytes * height, std::byte{0x5a}) {
        for (uint32_t y = 0; y < height; ++y) {
            for (uint32_t x = 0; x < width; ++x) {
                set(x, y, colour);
            }
        }
    }

    [[nodiscard]] PixelView view() const {
        return {bytes.data(), width_px, height_px, stride_bytes};
    }
    [[nodiscard]] Bytes at(uint32_t x, uint32_t y) const {
        const auto* pixel = bytes.data() + y * stride_bytes + size_t{4} * x;
        return {std::to_integer<uint8_t>(pixel[0]), std::to_integer<uint8_t>(pixel[1]),
                std::to_integer<uint8_t>(pixel[2])};
    }
    void set(uint32_t x, uint32_t y, Bytes colour) {
        auto* pixel = bytes.data() + y * stride_bytes + size_t{4} * x;
        for (size_t c = 0; c < 3; ++c) {
            pixel[c] = std::byte{colour[c]};
        }
        pixel[3] = std::byte{255};
    }
};

inline ShownPicture noise(uint32_t width, uint32_t height, uint32_t seed) {
    ShownPicture picture(width, height, {});
    std::mt19937 random(seed);
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            picture.set(x, y,
                        {static_cast<uint8_t>(random() & 255), static_cast<uint8_t>(random() & 255),
                         static_cast<uint8_t>(random() & 255)});
        }
    }
    return picture;
}

// Each byte moved by -amount .. amount, kept in 0..255.
inline ShownPicture disturbed(ShownPicture picture, int amount, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> by(-amount, amount);
    for (uint32_t y = 0; y < picture.height_px; ++y) {
        for (uint32_t x = 0; x < picture.width_px; ++x) {
            Bytes colour = picture.at(x, y);
            for (uint8_t& byte : colour) {
                byte = static_cast<uint8_t>(std::clamp(byte + by(random), 0, 255));
            }
            picture.set(x, y, colour);
        }
    }
    return picture;
}

inline LinearImage constantLinear(uint32_t width, uint32_t height, float value) {
    return {width, height, std::vector<float>(size_t{3} * width * height, value)};
}

// Log-normal radiance: a few bright pixels, many dark ones.
inline LinearImage linearNoise(uint32_t width, uint32_t height, uint32_t seed) {
    LinearImage image = constantLinear(width, height, 0);
    std::mt19937 random(seed);
    std::lognormal_distribution<float> radiance(-1, 2);
    for (float& value : image.rgb) {
        value = radiance(random);
    }
    return image;
}

} // namespace froxel::image_metrics

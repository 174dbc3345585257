// PNG files of every kind, made in memory by libpng itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace froxel::test {

struct PngSpec {
    uint32_t width_px = 1;
    uint32_t height_px = 1;
    int bit_depth = 8;
    int color_type = 2;                 // PNG_COLOR_TYPE_RGB
    std::vector<uint8_t> rows;          // as the file stores them, one after the other
    std::vector<uint8_t> palette;       // RGB triples, for a palette image
    std::vector<uint8_t> palette_alpha; // may be shorter than the palette
    bool interlaced = false;
};

[[nodiscard]] std::vector<std::byte> pngFile(const PngSpec& spec);

// An RGB image of one colour.
[[nodiscard]] std::vector<std::byte> plainPng(uint8_t red, uint8_t green, uint8_t blue);

// A well-formed PNG header that claims this size, with the data of a single pixel.
[[nodiscard]] std::vector<std::byte> pngClaiming(uint32_t width_px, uint32_t height_px);

} // namespace froxel::test

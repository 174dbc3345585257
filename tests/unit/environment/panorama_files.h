// Files of panoramas, as bytes.
#pragma once

#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfPixelType.h>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace froxel::environment {

[[nodiscard]] inline std::span<const std::byte> bytesOf(const std::string& text) {
    return std::as_bytes(std::span(text));
}

// A .hdr with this text before the resolution's line, and these pixels after it.
[[nodiscard]] std::string radianceFile(const std::string& resolution,
                                       const std::string& pixels,
                                       const std::string& format = "FORMAT=32-bit_rle_rgbe\n");

struct ExrChannel {
    std::string name;
    Imf::PixelType type = Imf::HALF;
    float value = 0; // of every pixel, plus its index
};
struct ExrLayout {
    int width = 4;
    int height = 2;
    Imf::Compression compression = Imf::ZIP_COMPRESSION;
    bool tiled = false;
    int parts = 1;
    bool cropped = false;    // the data window is smaller than the display window
    bool wide_gamut = false; // primaries of Rec. 2020
};
[[nodiscard]] std::string exrFile(const ExrLayout& layout, const std::vector<ExrChannel>& channels);

} // namespace froxel::environment

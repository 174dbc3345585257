#include "unit/png/png_file.h"

#include <gtest/gtest.h>
#include <png.h>

#include <zlib.h>

namespace froxel::test {
namespace {

using Bytes = std::vector<std::byte>;

void appendBytes(png_structp png, png_bytep data, size_t size) {
    auto* bytes = static_cast<Bytes*>(png_get_io_ptr(png));
    const auto* first = reinterpret_cast<const std::byte*>(data);
    bytes->insert(bytes->end(), first, first + size);
}

void putBigEndian(Bytes& bytes, size_t offset, uint32_t value) {
    for (unsigned i = 0; i < 4; ++i) {
        bytes.at(offset + i) = static_cast<std::byte>(value >> (24U - 8U * i));
    }
}

} // namespace

// The default error handler aborts: these files are valid, or the test is wrong.
Bytes pngFile(const PngSpec& spec) {
    Bytes bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &bytes, appendBytes, nullptr);
    png_set_IHDR(png, info, spec.width_px, spec.height_px, spec.bit_depth, spec.color_type,
                 spec.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    std::vector<png_color> palette;
    for (size_t i = 0; i + 2 < spec.palette.size(); i += 3) {
        palette.push_back({spec.palette[i], spec.palette[i + 1], spec.palette[i + 2]});
    }
    if (!palette.empty()) {
        png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
    }
    if (!spec.palette_alpha.empty()) {
        png_set_tRNS(png, info, spec.palette_alpha.data(),
                     static_cast<int>(spec.palette_alpha.size()), nullptr);
    }
    png_write_info(png, info);
    const size_t row_bytes = png_get_rowbytes(png, info);
    EXPECT_EQ(spec.rows.size(), row_bytes * spec.height_px);
    std::vector<uint8_t> copy = spec.rows;
    std::vector<png_bytep> rows;
    for (size_t y = 0; y < spec.height_px; ++y) {
        rows.push_back(copy.data() + y * row_bytes);
    }
    png_write_image(png, rows.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

Bytes plainPng(uint8_t red, uint8_t green, uint8_t blue) {
    PngSpec spec;
    spec.rows = {red, green, blue};
    return pngFile(spec);
}

Bytes pngClaiming(uint32_t width_px, uint32_t height_px) {
    constexpr size_t kHeader = 12; // behind the signature and the chunk's length: "IHDR"
    constexpr size_t kHeaderBytes = 17;
    Bytes bytes = plainPng(1, 2, 3);
    putBigEndian(bytes, kHeader + 4, width_px);
    putBigEndian(bytes, kHeader + 8, height_px);
    const auto* header = reinterpret_cast<const unsigned char*>(bytes.data() + kHeader);
    const uLong sum = crc32(crc32(0, nullptr, 0), header, kHeaderBytes);
    putBigEndian(bytes, kHeader + kHeaderBytes, static_cast<uint32_t>(sum));
    return bytes;
}

} // namespace froxel::test

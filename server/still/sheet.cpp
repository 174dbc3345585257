#include "still/sheet.h"

#include "core/pixel_view.h"
#include "encode/encoder.h"
#include "png/reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wconversion"
#include <stb_easy_font.h>
#pragma GCC diagnostic pop

namespace froxel::still {

namespace {

using Pixel = std::array<std::byte, 4>;

constexpr Pixel kBlack{std::byte{0}, std::byte{0}, std::byte{0}, std::byte{255}};
constexpr Pixel kWhite{std::byte{255}, std::byte{255}, std::byte{255}, std::byte{255}};

// [height][width]
struct Picture {
    Picture(uint32_t width, uint32_t height)
        : width_px(width), height_px(height), pixels(size_t{width} * height, kBlack) {}

    uint32_t width_px;
    uint32_t height_px;
    std::vector<Pixel> pixels;

    // What lies outside is left out.
    void fill(uint32_t x, uint32_t y, uint32_t width, uint32_t height, const Pixel& color) {
        const uint32_t end_x = std::min(width_px, x + width);
        const uint32_t end_y = std::min(height_px, y + height);
        for (uint32_t row = y; row < end_y; ++row) {
            for (uint32_t column = x; column < end_x; ++column) {
                pixels[size_t{row} * width_px + column] = color;
            }
        }
    }
};

// A vertex of stb_easy_font_print(): four to each rectangle, whose sides are whole numbers.
struct FontVertex {
    float x;
    float y;
    float z;
    std::array<unsigned char, 4> color;
};

// White on black at the upper left of a part, about a twentieth of its height.
void drawLabel(Picture& sheet, uint32_t x, uint32_t y, uint32_t part_height, std::string label) {
    constexpr uint32_t kLineHeight = 12; // of the font
    constexpr uint32_t kMargin = 2;
    const uint32_t scale = std::max(1U, part_height / (20 * kLineHeight));
    std::array<FontVertex, 4000> vertices{};
    const int count = stb_easy_font_print(0, 0, label.data(), nullptr, vertices.data(),
                                          static_cast<int>(sizeof vertices));
    const auto width = static_cast<uint32_t>(stb_easy_font_width(label.data()));
    sheet.fill(x, y, (width + 2 * kMargin) * scale, kLineHeight * scale, kBlack);
    for (size_t i = 0; i < static_cast<size_t>(count); ++i) {
        const FontVertex& from = vertices[4 * i];
        const FontVertex& to = vertices[4 * i + 2];
        const auto at = [&](float units) { return static_cast<uint32_t>(units) * scale; };
        sheet.fill(x + kMargin * scale + at(from.x), y + kMargin * scale + at(from.y),
                   at(to.x - from.x), at(to.y - from.y), kWhite);
    }
}

} // namespace

Result<SharedBytes> makeSheet(std::span<const SheetPart> parts,
                              const settings::Encoding& encoding) {
    const auto part_size = png::readSize(*parts.front().png);
    if (!part_size) {
        return part_size.error();
    }
    const auto [width, height] = *part_size;
    const auto count = static_cast<uint32_t>(parts.size());
    const auto columns = static_cast<uint32_t>(std::ceil(std::sqrt(count)));
    const uint32_t rows = (count + columns - 1) / columns;
    if (uint64_t{width} * height * columns * rows > kMostSheetArea_px) {
        return Error{ErrorCode::kCapacity, "the sheet is too large"};
    }
    Picture sheet(columns * width, rows * height);
    std::vector<Pixel> pixels(size_t{width} * height);
    for (uint32_t i = 0; i < count; ++i) {
        if (auto read = png::readPixels(*parts[i].png, std::as_writable_bytes(std::span(pixels)));
            !read) {
            return read.error();
        }
        const uint32_t x = i % columns * width;
        const uint32_t y = i / columns * height;
        for (uint32_t row = 0; row < height; ++row) {
            std::ranges::copy_n(pixels.begin() + static_cast<ptrdiff_t>(size_t{row} * width), width,
                                sheet.pixels.begin() +
                                    static_cast<ptrdiff_t>(size_t{y + row} * sheet.width_px + x));
        }
        drawLabel(sheet, x, y, height, parts[i].label);
    }
    const PixelView view{reinterpret_cast<const std::byte*>(sheet.pixels.data()), sheet.width_px,
                         sheet.height_px, size_t{sheet.width_px} * sizeof(Pixel)};
    auto encoded = encode::makeEncoder(encoding.codec, 1)->encode(view, encoding, true, {});
    if (!encoded) {
        return encoded.error();
    }
    return std::make_shared<const std::vector<std::byte>>(std::move(encoded->bytes));
}

} // namespace froxel::still

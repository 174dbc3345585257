#include "png/reader.h"
#include "unit/png/png_file.h"

#include <gtest/gtest.h>
#include <png.h>

#include <gmock/gmock.h>
#include <string>

namespace froxel::png {
namespace {

using test::plainPng;
using test::pngClaiming;
using test::pngFile;
using test::PngSpec;
using testing::ElementsAre;
using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

std::vector<int> pixelsOf(const Bytes& file) {
    const PictureSize size = readSize(file).value();
    Bytes rgba8(size_t{size.width_px} * size.height_px * 4);
    readPixels(file, rgba8).value();
    std::vector<int> values;
    for (const std::byte value : rgba8) {
        values.push_back(std::to_integer<int>(value));
    }
    return values;
}

std::string refusal(const Bytes& file, size_t byte_count) {
    Bytes rgba8(byte_count);
    const auto read = readPixels(file, rgba8);
    return read ? "" : read.error().message;
}

PngSpec spec(int color_type, int bit_depth, uint32_t width_px, std::vector<uint8_t> rows) {
    PngSpec result;
    result.width_px = width_px;
    result.bit_depth = bit_depth;
    result.color_type = color_type;
    result.rows = std::move(rows);
    return result;
}

TEST(IsPng, SignatureAlone_Decides) {
    Bytes file = plainPng(1, 2, 3);
    EXPECT_TRUE(isPng(file));
    file.resize(8);
    EXPECT_TRUE(isPng(file));
    file.resize(7);
    EXPECT_FALSE(isPng(file));
    EXPECT_FALSE(isPng({}));
    EXPECT_FALSE(isPng(Bytes(64, std::byte{0x42})));
}

TEST(ReadSize, Header_IsBelievedWhereTheFileCouldHoldThat) {
    const PictureSize size = readSize(pngClaiming(5'000, 2)).value();
    EXPECT_EQ(size.width_px, 5'000U);
    EXPECT_EQ(size.height_px, 2U);
    const auto too_many = readSize(pngClaiming(100'000, 2));
    ASSERT_FALSE(too_many);
    EXPECT_THAT(too_many.error().message,
                HasSubstr("bytes cannot hold the 100000x2 pixels that its header tells"));
}

TEST(ReadSize, SideOf0OrBeyond31Bits_IsRefused) {
    for (const uint32_t side : {0U, 0x8000'0000U, 0xFFFF'FFFFU}) {
        EXPECT_FALSE(readSize(pngClaiming(side, 1))) << side;
        EXPECT_FALSE(readSize(pngClaiming(1, side))) << side;
    }
}

TEST(ReadPixels, RgbPng_GetsAlpha255) {
    EXPECT_THAT(pixelsOf(plainPng(1, 2, 3)), ElementsAre(1, 2, 3, 255));
}

TEST(ReadPixels, RgbaPng_KeepsItsAlpha) {
    EXPECT_THAT(pixelsOf(pngFile(spec(PNG_COLOR_TYPE_RGB_ALPHA, 8, 1, {1, 2, 3, 4}))),
                ElementsAre(1, 2, 3, 4));
}

TEST(ReadPixels, GreyPng_BecomesRgb) {
    EXPECT_THAT(pixelsOf(pngFile(spec(PNG_COLOR_TYPE_GRAY, 8, 2, {7, 200}))),
                ElementsAre(7, 7, 7, 255, 200, 200, 200, 255));
    EXPECT_THAT(pixelsOf(pngFile(spec(PNG_COLOR_TYPE_GRAY, 1, 2, {0x40}))),
                ElementsAre(0, 0, 0, 255, 255, 255, 255, 255));
    EXPECT_THAT(pixelsOf(pngFile(spec(PNG_COLOR_TYPE_GRAY_ALPHA, 8, 1, {9, 8}))),
                ElementsAre(9, 9, 9, 8));
}

TEST(ReadPixels, SixteenBitPng_BecomesEight) {
    EXPECT_THAT(pixelsOf(pngFile(spec(PNG_COLOR_TYPE_RGB, 16, 1, {255, 255, 128, 128, 0, 0}))),
                ElementsAre(255, 128, 0, 255));
    EXPECT_THAT(pixelsOf(pngFile(spec(PNG_COLOR_TYPE_GRAY, 16, 1, {64, 64}))),
                ElementsAre(64, 64, 64, 255));
}

TEST(ReadPixels, PalettePng_IsLookedUp) {
    PngSpec image = spec(PNG_COLOR_TYPE_PALETTE, 8, 2, {1, 0});
    image.palette = {10, 20, 30, 40, 50, 60};
    image.palette_alpha = {99};
    EXPECT_THAT(pixelsOf(pngFile(image)), ElementsAre(40, 50, 60, 255, 10, 20, 30, 99));
}

TEST(ReadPixels, InterlacedPng_HasTopRowFirst) {
    PngSpec image = spec(PNG_COLOR_TYPE_GRAY, 8, 1, {5, 6});
    image.height_px = 2;
    image.interlaced = true;
    EXPECT_THAT(pixelsOf(pngFile(image)), ElementsAre(5, 5, 5, 255, 6, 6, 6, 255));
}

TEST(ReadPixels, TruncatedAnywhere_IsRefused) {
    const Bytes file = plainPng(1, 2, 3);
    for (size_t size = 0; size < file.size(); ++size) {
        const Bytes part(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_EQ(refusal(part, 4), "the file is cut off") << size;
    }
    EXPECT_EQ(readSize(Bytes(file.begin(), file.begin() + 20)).error().code, ErrorCode::kIo);
}

TEST(ReadPixels, DamagedAnywhere_IsReadOrRefused) {
    const Bytes file = plainPng(1, 2, 3);
    size_t refused = 0;
    for (size_t i = 0; i < file.size(); ++i) {
        for (const unsigned bit : {0U, 5U, 7U}) {
            Bytes damaged = file;
            damaged[i] ^= std::byte{1} << bit;
            refused += refusal(damaged, 4).empty() ? 0U : 1U;
        }
    }
    EXPECT_GT(refused, file.size()) << "sums of chunks see nearly all";
}

TEST(ReadPixels, FewerPixelsThanTheHeaderClaims_IsRefused) {
    EXPECT_NE(refusal(pngClaiming(64, 64), size_t{64} * 64 * 4), "");
}

TEST(ReadPixels, OtherSizeThanTheFiles_IsRefusedBeforeAnythingIsWritten) {
    EXPECT_EQ(refusal(plainPng(1, 2, 3), 8), "PNG of 1x1 pixels into 8 bytes");
    EXPECT_THAT(refusal(pngClaiming(0x7FFF'FFFF, 0x7FFF'FFFF), 4),
                HasSubstr("cannot hold the 2147483647x2147483647 pixels"));
}

} // namespace
} // namespace froxel::png

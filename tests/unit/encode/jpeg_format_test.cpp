#include "encode/jpeg_format.h"

#include <gtest/gtest.h>

namespace froxel::encode {

using settings::Chroma;
using settings::Encoding;

namespace {

void expectCode(const HuffmanCode& code, uint16_t bits, uint8_t length) {
    EXPECT_EQ(code.bits, bits);
    EXPECT_EQ(code.length, length);
}

} // namespace

// ITU-T T.81, tables K.1 to K.6.
TEST(JpegFormat, OfMiddleQuality_HasTheStandardsTables) {
    const auto format = jpegFormat({.quality = 50, .chroma = Chroma::k420});
    ASSERT_TRUE(format) << format.error().message;
    EXPECT_EQ(format->luma.quantisation[0], 16);
    EXPECT_EQ(format->luma.quantisation[1], 11); // the next in its row, not in the scan
    EXPECT_EQ(format->luma.quantisation[8], 12);
    EXPECT_EQ(format->luma.quantisation[63], 99);
    EXPECT_EQ(format->chroma.quantisation[0], 17);
    EXPECT_EQ(format->chroma.quantisation[2], 24);
    expectCode(format->luma.dc[0], 0b00, 2);
    expectCode(format->luma.dc[11], 0b111111110, 9);
    expectCode(format->chroma.dc[11], 0b11111111110, 11);
    expectCode(format->luma.ac[0x00], 0b1010, 4); // the block ends
    expectCode(format->luma.ac[0xf0], 0b11111111001, 11);
    expectCode(format->luma.ac[0xfa], 0b1111111111111110, 16);
    expectCode(format->chroma.ac[0x01], 0b01, 2);
    expectCode(format->luma.ac[0x0b], 0, 0); // no such symbol
}

TEST(JpegFormat, Sampling_IsTheChromas) {
    EXPECT_EQ(jpegFormat({.quality = 85, .chroma = Chroma::k420})->luma_sampling, 2U);
    EXPECT_EQ(jpegFormat({.quality = 85, .chroma = Chroma::k444})->luma_sampling, 1U);
}

TEST(JpegFormat, HeaderKnowsWhereThePicturesSizeStands) {
    const auto format = jpegFormat({.quality = 85});
    ASSERT_TRUE(format);
    ASSERT_LT(format->size_at + 3, format->header.size());
    for (const size_t at : {0U, 2U}) {
        EXPECT_EQ(format->header[format->size_at + at], std::byte{0});
        EXPECT_EQ(format->header[format->size_at + at + 1], std::byte{16});
    }
}

TEST(JpegFormat, OfNoQuality_IsRefused) {
    const auto format = jpegFormat({.quality = 0});
    ASSERT_FALSE(format);
    EXPECT_EQ(format.error().code, ErrorCode::kInvalidArgument);
}

TEST(JpegFormats, SameEncoding_IsMadeOnce) {
    JpegFormats formats;
    const auto first = formats.of({.quality = 85});
    ASSERT_TRUE(first);
    EXPECT_EQ(*formats.of({.quality = 85}), *first);
    EXPECT_NE(*formats.of({.quality = 86}), *first);
    EXPECT_NE(*formats.of({.quality = 85, .chroma = Chroma::k444}), *first);
    EXPECT_FALSE(formats.of({.quality = 101}));
    EXPECT_FALSE(formats.of({.quality = 101}));
}

} // namespace froxel::encode

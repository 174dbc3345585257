#include "encode/jpeg_encoder.h"
#include "unit/encode/decoded.h"
#include "unit/encode/picture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace froxel::encode {
namespace {

using settings::Chroma;

double psnr(const Picture& picture, const Decoded& decoded) {
    double sum = 0;
    for (uint32_t y = 0; y < picture.height_px; ++y) {
        for (uint32_t x = 0; x < picture.width_px; ++x) {
            for (uint32_t c = 0; c < 3; ++c) {
                const int back = decoded.rgb[(size_t{y} * picture.width_px + x) * 3 + c];
                sum += std::pow(picture.channel(x, y, c) - back, 2);
            }
        }
    }
    return 10 * std::log10(255.0 * 255.0 * 3 * picture.width_px * picture.height_px / sum);
}

double psnrOf(const Picture& picture, const settings::Encoding& encoding) {
    JpegEncoder encoder;
    return psnr(picture, decode(encoder.encode(picture.view(), encoding).value()));
}

TEST(JpegEncoder, DecodedPicture_IsCloseAndCloserWithQuality) {
    const Picture picture = makePicture(160, 120);
    const double low = psnrOf(picture, {30, Chroma::k444});
    const double middle = psnrOf(picture, {80, Chroma::k444});
    const double high = psnrOf(picture, {100, Chroma::k444});
    EXPECT_GT(low, 24);
    EXPECT_GT(middle, low + 3);
    EXPECT_GT(high, 42);
    EXPECT_GT(high, middle + 3);
}

TEST(JpegEncoder, Chroma_IsWhatWasAskedFor) {
    const Picture picture = makePicture(160, 120);
    JpegEncoder encoder;
    const auto half = encoder.encode(picture.view(), {90, Chroma::k420}).value();
    const auto full = encoder.encode(picture.view(), {90, Chroma::k444}).value();
    EXPECT_EQ(decode(half).subsampling, TJSAMP_420);
    EXPECT_EQ(decode(full).subsampling, TJSAMP_444);
    EXPECT_LT(half.size(), full.size());
    EXPECT_GT(psnr(picture, decode(full)), psnr(picture, decode(half)));
}

TEST(JpegEncoder, OddSizesAndPaddedRows_KeepEveryPixelInPlace) {
    for (const auto& [width, height, padding] : {std::tuple{1U, 1U, 0U},
                                                 {16U, 17U, 0U},
                                                 {17U, 16U, 12U},
                                                 {641U, 3U, 7U},
                                                 {2U, 255U, 1U}}) {
        const Picture picture = makePicture(width, height, padding);
        JpegEncoder encoder;
        const Decoded back = decode(encoder.encode(picture.view(), {100, Chroma::k444}).value());
        EXPECT_EQ(back.width, static_cast<int>(width));
        EXPECT_EQ(back.height, static_cast<int>(height));
        EXPECT_GT(psnr(picture, back), 36) << width << "x" << height;
    }
}

TEST(JpegEncoder, OneEncoder_TakesSizesUpAndDown) {
    JpegEncoder encoder;
    for (const uint32_t side : {16U, 512U, 33U, 300U}) {
        const Picture picture = makePicture(side, side);
        const auto jpeg = encoder.encode(picture.view(), {80, Chroma::k420}).value();
        const auto fresh = JpegEncoder().encode(picture.view(), {80, Chroma::k420}).value();
        EXPECT_EQ(jpeg, fresh) << side;
    }
}

TEST(JpegEncoder, Noise_AtBestQuality_FitsTheScratch) {
    Picture picture = makePicture(97, 61);
    uint32_t seed = 1;
    for (std::byte& byte : picture.bytes) {
        seed = seed * 1664525U + 1013904223U;
        byte = static_cast<std::byte>(seed >> 24U);
    }
    JpegEncoder encoder;
    EXPECT_TRUE(encoder.encode(picture.view(), {100, Chroma::k444}));
    EXPECT_TRUE(encoder.encode(picture.view(), {100, Chroma::k420}));
}

TEST(JpegEncoder, BadInput_IsAnErrorThatNamesIt) {
    const Picture picture = makePicture(16, 16);
    JpegEncoder encoder;
    const auto message = [&](const PixelView& view, uint32_t quality) {
        const auto result = encoder.encode(view, {quality, Chroma::k420});
        return result ? std::string("accepted") : result.error().message;
    };
    EXPECT_EQ(message(picture.view(), 0), "JPEG quality is 0; it must be from 1 to 100");
    EXPECT_EQ(message(picture.view(), 101), "JPEG quality is 101; it must be from 1 to 100");
    EXPECT_EQ(message({}, 80), "JPEG of 0x0 pixels; 1 to 65500 a side are possible");
    PixelView narrow = picture.view();
    narrow.stride_bytes = 63;
    EXPECT_EQ(message(narrow, 80), "JPEG from rows of 63 bytes; 16 pixels need 64");
}

} // namespace
} // namespace froxel::encode

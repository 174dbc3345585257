// Read again by the library that panoramas are read with.
#include "core/linear_image.h"
#include "encode/radiance_encoder.h"
#include "environment/reader.h"
#include "unit/encode/picture.h"

#include <gtest/gtest.h>

namespace froxel::encode {
namespace {

LinearImage readAgain(const Picture& picture) {
    auto encoded = makeExrEncoder(1)->encode(picture.view(), {}, false, {});
    EXPECT_TRUE(encoded) << encoded.error().message;
    auto panorama = environment::read(encoded->bytes, "picture");
    EXPECT_TRUE(panorama) << panorama.error().message;
    EXPECT_TRUE(panorama->warnings.empty());
    return std::move(panorama->image);
}

TEST(ExrEncoder, Radiance_ComesToTheBit) {
    const Picture picture = makeRadiance(90, 45, 1);
    const LinearImage image = readAgain(picture);
    ASSERT_EQ(image.rgb.size(), size_t{90} * 45 * 3);
    size_t differing = 0;
    for (size_t i = 0; i < image.rgb.size(); ++i) {
        differing += image.rgb[i] != picture.radiance[i / 3 * 4 + i % 3] ? 1U : 0U;
    }
    EXPECT_EQ(differing, 0U);
}

TEST(ExrEncoder, SeveralSamples_ComeAsTheirMean) {
    const Picture picture = makeRadiance(4, 2, 2);
    const LinearImage image = readAgain(picture);
    ASSERT_EQ(image.width_px, 4U);
    ASSERT_EQ(image.height_px, 2U);
    const auto sample = [&](size_t x, size_t y, size_t channel) {
        return picture.radiance[(y * 8 + x) * 4 + channel];
    };
    for (size_t y = 0; y < 2; ++y) {
        for (size_t x = 0; x < 4; ++x) {
            for (size_t channel = 0; channel < 3; ++channel) {
                const double mean =
                    0.25 *
                    (double{sample(2 * x, 2 * y, channel)} + sample(2 * x + 1, 2 * y, channel) +
                     sample(2 * x, 2 * y + 1, channel) + sample(2 * x + 1, 2 * y + 1, channel));
                EXPECT_NEAR(image.rgb[(y * 4 + x) * 3 + channel] / mean, 1, 1e-6);
            }
        }
    }
}

TEST(ExrEncoder, PixelsWithoutRadiance_AreRefused) {
    const auto refused = makeExrEncoder(1)->encode(makePicture(8, 8).view(), {}, false, {});
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
}

} // namespace
} // namespace froxel::encode

#include "image_metrics/flip.h"
#include "image_metrics/picture_error.h"
#include "unit/image_metrics/flip_oracle.h"
#include "unit/image_metrics/pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace froxel::image_metrics {
namespace {

constexpr Bytes kBlack = {0, 0, 0};
constexpr Bytes kWhite = {255, 255, 255};

double flipOf(const ShownPicture& a, const ShownPicture& b) {
    return perceivedDifference(a.view(), b.view()).flip;
}

oracle::Colours linearOf(const ShownPicture& picture) {
    oracle::Colours colours{
        static_cast<int>(picture.width_px), static_cast<int>(picture.height_px), {}};
    for (uint32_t y = 0; y < picture.height_px; ++y) {
        for (uint32_t x = 0; x < picture.width_px; ++x) {
            glm::dvec3 linear;
            for (int c = 0; c < 3; ++c) {
                const double s = picture.at(x, y)[static_cast<size_t>(c)] / 255.0;
                linear[c] = s > 0.04045 ? std::pow((s + 0.055) / 1.055, 2.4) : s / 12.92;
            }
            colours.pixels.push_back(linear);
        }
    }
    return colours;
}

// L*a*b* (D65) of sRGB's primaries as published: Lindbloom's CIE colour calculator.
TEST(HuntAdjustedLab, Primaries_ArePublishedLabScaledByLightness) {
    struct {
        flip::Rgb linear;
        double l, a, b;
    } const cases[] = {{{1, 0, 0}, 53.2408, 80.0925, 67.2032},
                       {{0, 1, 0}, 87.7347, -86.1827, 83.1793},
                       {{0, 0, 1}, 32.2970, 79.1875, -107.8602}};
    for (const auto& c : cases) {
        const auto lab = flip::huntAdjustedLab(c.linear);
        EXPECT_NEAR(lab[0], c.l, 0.01);
        EXPECT_NEAR(lab[1], c.l / 100 * c.a, 0.02);
        EXPECT_NEAR(lab[2], c.l / 100 * c.b, 0.02);
    }
}

TEST(HuntAdjustedLab, Greys_HaveNoColour) {
    for (const float grey : {0.0F, 0.001F, 0.18F, 1.0F}) {
        const auto lab = flip::huntAdjustedLab({grey, grey, grey});
        EXPECT_NEAR(lab[1], 0, 1e-4);
        EXPECT_NEAR(lab[2], 0, 1e-4);
    }
    EXPECT_NEAR(flip::huntAdjustedLab({1, 1, 1})[0], 100, 1e-4);
    EXPECT_NEAR(flip::huntAdjustedLab({0, 0, 0})[0], 0, 1e-5);
}

// By hand: |10 - 4| + sqrt(3^2 + 4^2) = 11.
TEST(Hyab, LightnessAndColour_AddUp) {
    EXPECT_FLOAT_EQ(flip::hyab({10, 1, 2}, {4, 4, 6}), 11);
}

// By hand from the published L*a*b* above. Green and blue, Hunt-adjusted: (87.7347,
// -75.6123, 72.9771) and (32.2970, 25.5752, -34.8356): HyAB 55.4377 + sqrt(101.1875^2 + 107.8127^2)
// = 203.2973, to 0.7: 41.2755. White against black: 100 to 0.7 = 25.1189; knee 0.4 * 41.2755
// = 16.5102.
TEST(ColourError, WhiteAgainstBlack_IsThatByHand) {
    const double by_hand = 0.95 + (25.1189 - 16.5102) / (41.2755 - 16.5102) * 0.05;
    EXPECT_NEAR(flip::colourError(100), by_hand, 1e-5);
    EXPECT_NEAR(by_hand, 0.96738, 1e-5);
}

TEST(ColourError, ZeroKneeAndLargest_AreTheEnds) {
    EXPECT_EQ(flip::colourError(0), 0);
    EXPECT_NEAR(flip::colourError(static_cast<float>(std::pow(16.5102, 1 / 0.7))), 0.95, 1e-4);
    EXPECT_NEAR(flip::colourError(203.2973F), 1, 1e-4);
}

TEST(LdrFlip, EqualPictures_Are0) {
    EXPECT_EQ(flipOf(noise(31, 17, 1), noise(31, 17, 1)), 0);
}

// Without edges a picture's error is its colours' error.
TEST(LdrFlip, ConstantPictures_HaveTheirColoursError) {
    EXPECT_NEAR(flipOf({33, 20, kBlack}, {33, 20, kWhite}), 0.96738, 1e-4);
    EXPECT_NEAR(flipOf({33, 20, {0, 255, 0}}, {33, 20, {0, 0, 255}}), 1, 1e-4);
}

TEST(LdrFlip, OnePixel_IsItsColoursError) {
    EXPECT_NEAR(flipOf({1, 1, kBlack}, {1, 1, kWhite}), 0.96738, 1e-4);
    EXPECT_EQ(flipOf({1, 1, {3, 200, 77}}, {1, 1, {3, 200, 77}}), 0);
}

TEST(LdrFlip, SwappedPictures_AreAsFarApart) {
    EXPECT_EQ(flipOf(noise(31, 17, 1), noise(31, 17, 2)),
              flipOf(noise(31, 17, 2), noise(31, 17, 1)));
}

TEST(LdrFlip, LargerDisturbance_IsALargerError) {
    const auto reference = disturbed({48, 32, {128, 128, 128}}, 40, 3);
    double last = 0;
    for (const int amount : {2, 8, 32, 96}) {
        const double error = flipOf(disturbed(reference, amount, 4), reference);
        EXPECT_GT(error, last) << amount;
        EXPECT_LE(error, 1);
        last = error;
    }
}

TEST(LdrFlip, NewEdge_WeighsMoreThanItsColourAlone) {
    const ShownPicture reference(40, 24, {128, 128, 128});
    ShownPicture picture = reference;
    for (uint32_t y = 0; y < 24; ++y) {
        picture.set(20, y, {150, 150, 150});
    }
    const double colour_alone =
        oracle::meanColourError(linearOf(picture), linearOf(reference), kPixelsPerDegree);
    EXPECT_GT(colour_alone, 0);
    EXPECT_GT(flipOf(picture, reference), 1.2 * colour_alone);
}

TEST(LdrFlip, RowPadding_IsNotRead) {
    const auto picture = noise(9, 7, 5);
    ShownPicture padded(9, 7, kBlack, 12);
    for (uint32_t y = 0; y < 7; ++y) {
        for (uint32_t x = 0; x < 9; ++x) {
            padded.set(x, y, picture.at(x, y));
        }
    }
    EXPECT_EQ(flipOf(padded, picture), 0);
}

class LdrFlipOracle : public testing::TestWithParam<std::pair<uint32_t, uint32_t>> {};

TEST_P(LdrFlipOracle, UnseparatedDoubles_Agree) {
    const auto [width, height] = GetParam();
    const auto reference = noise(width, height, 6);
    for (const int amount : {1, 20, 255}) {
        const auto picture = disturbed(reference, amount, 7);
        const double expected = oracle::meanOf(
            oracle::flipMap(linearOf(picture), linearOf(reference), kPixelsPerDegree));
        EXPECT_NEAR(flipOf(picture, reference), expected, 2e-5 + 1e-4 * expected) << amount;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Sizes,
    LdrFlipOracle,
    testing::Values(std::pair{1U, 1U}, std::pair{1U, 9U}, std::pair{23U, 17U}, std::pair{40U, 3U}));

// Blue blurs further than the rest: across saturated edges the filtered colours leave the RGB cube.
TEST(LdrFlip, SaturatedEdges_AgreeWithUnseparatedDoubles) {
    ShownPicture reference(36, 8, {0, 0, 255});
    ShownPicture picture(36, 8, {255, 255, 0});
    for (uint32_t y = 0; y < 8; ++y) {
        for (uint32_t x = 0; x < 36; ++x) {
            if (x % 18 < 9) {
                reference.set(x, y, {255, 255, 0});
                picture.set(x, y, {0, 255, 0});
            }
        }
    }
    const double expected =
        oracle::meanOf(oracle::flipMap(linearOf(picture), linearOf(reference), kPixelsPerDegree));
    EXPECT_NEAR(flipOf(picture, reference), expected, 1e-4 * expected);
}

oracle::Colours coloursOf(const LinearImage& image) {
    oracle::Colours colours{
        static_cast<int>(image.width_px), static_cast<int>(image.height_px), {}};
    for (size_t i = 0; i < image.rgb.size(); i += 3) {
        colours.pixels.emplace_back(image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]);
    }
    return colours;
}

TEST(HdrFlip, UnseparatedDoubles_Agree) {
    const auto reference = linearNoise(21, 14, 6);
    for (const float change : {0.01F, 3.0F}) {
        auto picture = reference;
        for (size_t i = 0; i < picture.rgb.size(); i += 2) {
            picture.rgb[i] *= 1 + change;
        }
        const double expected =
            oracle::meanHdrFlip(coloursOf(picture), coloursOf(reference), kPixelsPerDegree);
        EXPECT_GT(expected, 0);
        EXPECT_NEAR(hdrFlip(picture, reference), expected, 2e-5 + 1e-4 * expected) << change;
    }
}

TEST(HdrFlip, EqualPictures_Are0) {
    EXPECT_EQ(hdrFlip(linearNoise(20, 12, 1), linearNoise(20, 12, 1)), 0);
    EXPECT_EQ(hdrFlip(constantLinear(3, 3, 0), constantLinear(3, 3, 0)), 0);
}

TEST(HdrFlip, LargerError_IsLarger) {
    const auto reference = linearNoise(32, 20, 2);
    double last = 0;
    for (const float factor : {1.01F, 1.1F, 2.0F}) {
        auto picture = reference;
        for (float& value : picture.rgb) {
            value *= factor;
        }
        const double error = hdrFlip(picture, reference);
        EXPECT_GT(error, last);
        EXPECT_LT(error, 1);
        last = error;
    }
}

// Exposures come from the reference: what is the same in other units is as wrong.
TEST(HdrFlip, BothScaled_IsTheSame) {
    auto picture = linearNoise(24, 16, 3);
    auto reference = linearNoise(24, 16, 4);
    const double error = hdrFlip(picture, reference);
    for (auto* image : {&picture, &reference}) {
        for (float& value : image->rgb) {
            value *= 1024;
        }
    }
    EXPECT_NEAR(hdrFlip(picture, reference), error, 1e-4);
}

// A constant reference is its own peak and median, so every exposure shows it as 0.85. By hand,
// against black: L* is 116 * 0.85^(1/3) - 16 = 93.8831, to 0.7: 24.0332.
TEST(HdrFlip, ConstantAgainstBlack_IsThatByHand) {
    const double error = hdrFlip(constantLinear(8, 8, 0), constantLinear(8, 8, 37));
    EXPECT_NEAR(error, 0.95 + (24.0332 - 16.5102) / 24.7653 * 0.05, 1e-4);
}

// Dark by 1,000 beside a bright pixel: an exposure for the median shows what one for the peak
// hides.
TEST(HdrFlip, ErrorInTheDark_IsSeen) {
    auto reference = constantLinear(40, 40, 0.001F);
    for (size_t i = 0; i < 30; ++i) {
        reference.rgb[i] = 1;
    }
    auto picture = reference;
    for (size_t i = reference.rgb.size() / 2; i < reference.rgb.size(); ++i) {
        picture.rgb[i] = 0.0005F;
    }
    EXPECT_GT(hdrFlip(picture, reference), 0.1);
}

TEST(HdrFlip, LargestFloats_AreFinite) {
    const auto image = constantLinear(4, 4, std::numeric_limits<float>::max());
    EXPECT_EQ(hdrFlip(image, image), 0);
    const double error = hdrFlip(image, constantLinear(4, 4, 1));
    EXPECT_GT(error, 0);
    EXPECT_LE(error, 1);
}

// Pictures of several bands, whose borders do not show.
TEST(FlipErrors, OfATallPicture_AreThoseOfThePlanesAsAWhole) {
    const auto planes = [](const ShownPicture& picture) {
        Plane<float> plane{picture.width_px, picture.height_px, {}};
        flip::RgbPlanes whole = {plane, plane, plane};
        for (uint32_t y = 0; y < picture.height_px; ++y) {
            for (uint32_t x = 0; x < picture.width_px; ++x) {
                for (size_t c = 0; c < 3; ++c) {
                    whole[c].values.push_back(
                        flip::linearFromSrgb(static_cast<float>(picture.at(x, y)[c]) / 255));
                }
            }
        }
        return whole;
    };
    for (const uint32_t height : {1U, 127U, 128U, 129U, 300U}) {
        const auto reference = noise(9, height, 7);
        const auto picture = disturbed(reference, 20, 8);
        EXPECT_EQ(flipErrors(picture.view(), reference.view()).values,
                  flip::errors(planes(picture), planes(reference), kPixelsPerDegree).values)
            << height;
    }
}

TEST(HdrFlip, NonFiniteValue_IsNaN) {
    for (const float bad :
         {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
          std::numeric_limits<float>::quiet_NaN()}) {
        auto image = linearNoise(8, 8, 5);
        const auto clean = image;
        image.rgb[50] = bad;
        EXPECT_TRUE(std::isnan(hdrFlip(image, clean)));
        EXPECT_TRUE(std::isnan(hdrFlip(clean, image)));
    }
}

} // namespace
} // namespace froxel::image_metrics

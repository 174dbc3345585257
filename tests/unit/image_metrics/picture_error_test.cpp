#include "image_metrics/picture_error.h"
#include "unit/image_metrics/pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace froxel::image_metrics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

LinearImage with(LinearImage image, size_t index, float value) {
    image.rgb.at(index) = value;
    return image;
}

TEST(LinearDifference, EqualPictures_AreEqual) {
    const auto image = linearNoise(13, 7, 1);
    const auto stats = linearDifference(image, image);
    EXPECT_EQ(stats.max_abs, 0);
    EXPECT_EQ(stats.p999_abs, 0);
    EXPECT_EQ(stats.rmse, 0);
    EXPECT_EQ(stats.relative_rmse, 0);
    EXPECT_EQ(stats.psnr_db, kInfinity);
    EXPECT_EQ(stats.pixel_count, 91u);
    EXPECT_EQ(stats.differing_count, 0u);
    EXPECT_EQ(stats.nonfinite_count, 0u);
}

// By hand: 1 of 12 values off by 0.5 from 0.25: RMSE sqrt(0.25 / 12), relative
// sqrt(0.25 / 0.0725 / 12); PSNR 20 log10(1 / 0.144338) = 16.8124.
TEST(LinearDifference, OneValueOff_IsThatByHand) {
    const auto reference = constantLinear(2, 2, 0.25F);
    const auto stats = linearDifference(with(reference, 4, 0.75F), reference);
    EXPECT_EQ(stats.max_abs, 0.5);
    EXPECT_DOUBLE_EQ(stats.rmse, std::sqrt(0.25 / 12));
    EXPECT_DOUBLE_EQ(stats.relative_rmse, std::sqrt(0.25 / 0.0725 / 12));
    EXPECT_NEAR(stats.psnr_db, 16.8124, 1e-4);
    EXPECT_EQ(stats.differing_count, 1u);
}

TEST(LinearDifference, Peak_ShiftsPsnr) {
    const auto reference = constantLinear(2, 2, 0.25F);
    const auto picture = with(reference, 0, 0.5F);
    EXPECT_NEAR(linearDifference(picture, reference, 10).psnr_db,
                linearDifference(picture, reference).psnr_db + 20, 1e-9);
}

// 3,000 values 1 to 3000 apart: the 99.9th percentile is the 2,997th.
TEST(LinearDifference, Percentile_IsItsRank) {
    const auto reference = constantLinear(50, 20, 0);
    auto picture = reference;
    for (size_t i = 0; i < 3000; ++i) {
        picture.rgb[i] = static_cast<float>(3000 - i);
    }
    const auto stats = linearDifference(picture, reference);
    EXPECT_EQ(stats.p999_abs, 2997);
    EXPECT_EQ(stats.max_abs, 3000);
    EXPECT_EQ(stats.differing_count, 1000u);
}

TEST(LinearDifference, SignOfZero_IsNoDifference) {
    EXPECT_EQ(
        linearDifference(constantLinear(2, 2, -0.0F), constantLinear(2, 2, 0)).differing_count, 0u);
}

TEST(LinearDifference, NonFinitePixel_IsCountedAndLeftOut) {
    const auto reference = constantLinear(3, 1, 1);
    for (const float bad :
         {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
          std::numeric_limits<float>::quiet_NaN()}) {
        const auto picture = with(with(reference, 1, bad), 8, 1.5F);
        for (const auto& stats :
             {linearDifference(picture, reference), linearDifference(reference, picture)}) {
            EXPECT_EQ(stats.nonfinite_count, 1u);
            EXPECT_EQ(stats.pixel_count, 3u);
            EXPECT_EQ(stats.differing_count, 1u);
            EXPECT_EQ(stats.max_abs, 0.5);
            EXPECT_DOUBLE_EQ(stats.rmse, std::sqrt(0.25 / 6));
        }
    }
}

TEST(LinearDifference, NoFinitePixel_HasNoError) {
    const auto bad = constantLinear(2, 1, std::numeric_limits<float>::quiet_NaN());
    const auto stats = linearDifference(bad, bad);
    EXPECT_EQ(stats.nonfinite_count, 2u);
    EXPECT_TRUE(std::isnan(stats.max_abs));
    EXPECT_TRUE(std::isnan(stats.p999_abs));
    EXPECT_TRUE(std::isnan(stats.rmse));
    EXPECT_TRUE(std::isnan(stats.psnr_db));
}

TEST(LinearDifference, LargestFloats_DoNotOverflow) {
    const float largest = std::numeric_limits<float>::max();
    const auto stats = linearDifference(constantLinear(1, 1, largest), constantLinear(1, 1, 0));
    EXPECT_EQ(stats.max_abs, largest);
    EXPECT_NEAR(stats.rmse / largest, 1, 1e-12);
}

TEST(ShownDifference, BlackAgainstWhite_IsThePeak) {
    const auto stats = shownDifference(ShownPicture(5, 4, {0, 0, 0}).view(),
                                       ShownPicture(5, 4, {255, 255, 255}).view());
    EXPECT_EQ(stats.max_abs, 1);
    EXPECT_DOUBLE_EQ(stats.rmse, 1);
    EXPECT_NEAR(stats.psnr_db, 0, 1e-12);
    EXPECT_EQ(stats.differing_count, 20u);
}

// One step everywhere: 20 log10(255) = 48.1308 dB, the usual PSNR of an MSE of 1.
TEST(ShownDifference, OneStepEverywhere_Is48dB) {
    const auto stats = shownDifference(ShownPicture(5, 4, {7, 100, 254}, 8).view(),
                                       ShownPicture(5, 4, {8, 101, 255}).view());
    EXPECT_NEAR(stats.psnr_db, 48.1308, 1e-4);
    EXPECT_NEAR(stats.max_abs, 1.0 / 255, 1e-7);
}

TEST(PerceivedDifference, StepsAboveOne_AreCounted) {
    const ShownPicture reference(4, 1, {100, 100, 100});
    ShownPicture picture = reference;
    picture.set(0, 0, {101, 99, 101});
    picture.set(1, 0, {100, 102, 100});
    picture.set(2, 0, {0, 0, 0});
    EXPECT_EQ(perceivedDifference(picture.view(), reference.view()).above_1_255_count, 2u);
}

TEST(PerceivedDifference, EqualPictures_AreEqual) {
    const auto stats = perceivedDifference(noise(30, 20, 1).view(), noise(30, 20, 1).view());
    EXPECT_EQ(stats.above_1_255_count, 0u);
    EXPECT_EQ(stats.mssim, 1);
    EXPECT_EQ(stats.flip, 0);
}

double mssimOf(const ShownPicture& a, const ShownPicture& b) {
    return perceivedDifference(a.view(), b.view()).mssim;
}

// Constant pictures have no variance: (2 a b + C1) / (a^2 + b^2 + C1), C1 = 2.55^2 (Wang et al.
// 2004).
TEST(Mssim, ConstantPictures_HaveTheClosedForm) {
    const double c1 = 2.55 * 2.55;
    EXPECT_NEAR(mssimOf({20, 15, {0, 0, 0}}, {20, 15, {255, 255, 255}}), c1 / (255 * 255 + c1),
                1e-9);
    EXPECT_NEAR(mssimOf({20, 15, {100, 100, 100}}, {20, 15, {150, 150, 150}}),
                (2 * 100 * 150 + c1) / (100 * 100 + 150 * 150 + c1), 1e-9);
}

TEST(Mssim, PicturesBelowTheWindow_HaveTheClosedFormToo) {
    const double c1 = 2.55 * 2.55;
    for (const auto& [width, height] : {std::pair{1U, 1U}, {10U, 30U}, {30U, 2U}}) {
        EXPECT_NEAR(mssimOf({width, height, {100, 100, 100}}, {width, height, {150, 150, 150}}),
                    (2 * 100 * 150 + c1) / (100 * 100 + 150 * 150 + c1), 1e-9);
        EXPECT_EQ(mssimOf(noise(width, height, 3), noise(width, height, 3)), 1);
    }
}

// One window only: the formula by loops, weights from the paper.
TEST(Mssim, OneWindow_IsTheFormula) {
    const auto a = noise(11, 11, 4);
    const auto b = disturbed(a, 60, 5);
    const auto luma = [](const Bytes& p) { return 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2]; };
    double weights = 0, ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
    for (uint32_t y = 0; y < 11; ++y) {
        for (uint32_t x = 0; x < 11; ++x) {
            const double dx = x - 5.0;
            const double dy = y - 5.0;
            const double w = std::exp(-(dx * dx + dy * dy) / (2 * 1.5 * 1.5));
            const double va = luma(a.at(x, y));
            const double vb = luma(b.at(x, y));
            weights += w;
            ma += w * va;
            mb += w * vb;
            aa += w * va * va;
            bb += w * vb * vb;
            ab += w * va * vb;
        }
    }
    for (double* sum : {&ma, &mb, &aa, &bb, &ab}) {
        *sum /= weights;
    }
    const double c1 = 2.55 * 2.55;
    const double c2 = 7.65 * 7.65;
    const double expected = (2 * ma * mb + c1) * (2 * (ab - ma * mb) + c2) /
                            ((ma * ma + mb * mb + c1) * (aa - ma * ma + bb - mb * mb + c2));
    EXPECT_NEAR(mssimOf(a, b), expected, 1e-10);
}

TEST(Mssim, OppositePattern_IsNegative) {
    ShownPicture a(24, 24, {0, 0, 0});
    ShownPicture b = a;
    for (uint32_t y = 0; y < 24; ++y) {
        for (uint32_t x = 0; x < 24; ++x) {
            const uint8_t value = (x + y) % 2 == 0 ? 255 : 0;
            const auto opposite = static_cast<uint8_t>(255 - value);
            a.set(x, y, {value, value, value});
            b.set(x, y, {opposite, opposite, opposite});
        }
    }
    EXPECT_LT(mssimOf(a, b), -0.9);
    EXPECT_GE(mssimOf(a, b), -1);
}

TEST(Mssim, LargerDisturbance_IsLessSimilar) {
    const auto reference = noise(40, 30, 6);
    double last = 1;
    for (const int amount : {4, 16, 64, 255}) {
        const double similarity = mssimOf(disturbed(reference, amount, 7), reference);
        EXPECT_LT(similarity, last);
        EXPECT_EQ(similarity, mssimOf(reference, disturbed(reference, amount, 7)));
        last = similarity;
    }
}

TEST(TileEdgeRatio, NoError_Is0) {
    const auto image = linearNoise(16, 16, 1);
    EXPECT_EQ(tileEdgeRatio(image, image, {4, 4}), 0);
}

TEST(TileEdgeRatio, ErrorWithoutTiles_IsNear1) {
    EXPECT_NEAR(tileEdgeRatio(linearNoise(256, 256, 1), constantLinear(256, 256, 0), {16, 16}), 1,
                0.1);
}

TEST(TileEdgeRatio, ConstantError_Is1) {
    EXPECT_EQ(tileEdgeRatio(constantLinear(16, 16, 2), constantLinear(16, 16, 1), {4, 4}), 1);
}

// Error 1 in every other column of tiles, 0 between: steps only at vertical borders.
TEST(TileEdgeRatio, ErrorByTile_IsInfinite) {
    const auto reference = constantLinear(16, 8, 1);
    auto picture = reference;
    for (size_t i = 0; i < picture.rgb.size(); ++i) {
        picture.rgb[i] += (i / 3 % 16) / 4 % 2 == 0 ? 1.0F : 0.0F;
    }
    EXPECT_EQ(tileEdgeRatio(picture, reference, {4, 4}), kInfinity);
    // The same error under tiles whose borders lie elsewhere: no step at any.
    EXPECT_EQ(tileEdgeRatio(picture, reference, {5, 8}), 0);
}

// By hand: 4x1, errors 0 1 4 5, tiles of 2: border step 3, elsewhere (1 + 1) / 2.
TEST(TileEdgeRatio, OneRow_IsThatByHand) {
    auto picture = constantLinear(4, 1, 0);
    const std::array<float, 4> errors = {0, 1, 4, 5};
    for (size_t i = 0; i < picture.rgb.size(); ++i) {
        picture.rgb[i] = errors.at(i / 3);
    }
    EXPECT_DOUBLE_EQ(tileEdgeRatio(picture, constantLinear(4, 1, 0), {2, 1}), 3);
}

TEST(TileEdgeRatio, OneKindOfSteps_Is1) {
    const auto picture = linearNoise(5, 5, 2);
    const auto reference = constantLinear(5, 5, 0);
    EXPECT_EQ(tileEdgeRatio(picture, reference, {8, 8}), 1); // no border inside
    EXPECT_EQ(tileEdgeRatio(picture, reference, {1, 1}), 1); // nothing but borders
    EXPECT_EQ(tileEdgeRatio(constantLinear(1, 1, 2), constantLinear(1, 1, 1), {8, 8}), 1);
}

TEST(TileEdgeRatio, NonFinitePixels_AreLeftOut) {
    auto picture = constantLinear(4, 1, 1);
    const auto reference = constantLinear(4, 1, 0);
    picture.rgb[0] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(tileEdgeRatio(picture, reference, {2, 1}), 1);
}

TEST(PictureErrorDeathTest, DifferentOrEmptyPictures_AreABug) {
    EXPECT_DEATH((void)linearDifference(constantLinear(2, 2, 0), constantLinear(2, 3, 0)),
                 "one size");
    EXPECT_DEATH((void)linearDifference({}, {}), "have pixels");
    EXPECT_DEATH((void)shownDifference({}, {}), "have pixels");
    EXPECT_DEATH((void)tileEdgeRatio(constantLinear(2, 2, 0), constantLinear(2, 2, 0), {0, 4}),
                 "tiles have a size");
}

} // namespace
} // namespace froxel::image_metrics

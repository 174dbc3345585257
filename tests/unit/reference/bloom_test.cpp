#include "reference/bloom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace froxel::reference {
namespace {

LinearImage black(uint32_t width_px, uint32_t height_px) {
    LinearImage image{width_px, height_px, {}};
    image.rgb.resize(size_t{width_px} * height_px * 3);
    return image;
}

float& red(LinearImage& image, size_t x, size_t y) {
    return image.rgb[3 * (y * image.width_px + x)];
}

double sumOf(const LinearImage& image) {
    return std::accumulate(image.rgb.begin(), image.rgb.end(), 0.0);
}

TEST(ReferenceBloom, BrightPart_SetsInAsAParabolaAroundTheThreshold) {
    const glm::dvec3 color(1, 0.5, 0.25);
    EXPECT_EQ(brightPart(color, 0, 0), color);
    EXPECT_EQ(brightPart(color, 2, 0), glm::dvec3(0));
    EXPECT_EQ(brightPart(color, 0.25, 0), 0.75 * color);
    EXPECT_EQ(brightPart(color, 1.5, 0.5), glm::dvec3(0)); // where the knee begins
    EXPECT_EQ(brightPart(color, 0.5, 0.5), 0.5 * color);   // where it ends
    EXPECT_NEAR(brightPart(color, 1, 0.5).x, 0.125,
                1e-15); // at the threshold a quarter of the knee
    EXPECT_EQ(brightPart(glm::dvec3(0), 0, 0), glm::dvec3(0));
}

// In the middle of 200 x 200 pixels: a Gaussian of standard deviation 4, moved by half.
TEST(ReferenceBloom, OnePixel_BecomesAGaussian) {
    LinearImage image = black(200, 200);
    red(image, 100, 100) = 100;
    const settings::Bloom bloom{settings::BloomKind::kSeparable, 0, 0, 0.5F, 0.02F};
    LinearImage result = spread(image, bloom, 1);
    const double peak = 50 / (2 * std::numbers::pi * 16);
    EXPECT_NEAR(red(result, 100, 100), 50 + peak, 1e-4);
    EXPECT_NEAR(red(result, 104, 100), peak * std::exp(-0.5), 1e-4);
    EXPECT_NEAR(red(result, 104, 92), peak * std::exp(-2.5), 1e-4);
    EXPECT_NEAR(sumOf(result), 100, 1e-3);
}

TEST(ReferenceBloom, LightAtABorder_StaysInThePicture) {
    LinearImage image = black(30, 20);
    red(image, 0, 0) = 7;
    red(image, 29, 10) = 5;
    const settings::Bloom bloom{settings::BloomKind::kMipChain, 0.5F, 1, 1, 0.05F};
    EXPECT_NEAR(sumOf(spread(image, bloom, 1)), 12, 1e-5);
}

TEST(ReferenceBloom, Threshold_IsOfExposedRadiance) {
    LinearImage image = black(16, 16);
    red(image, 8, 8) = 3;
    const settings::Bloom bloom{settings::BloomKind::kMipChain, 1, 0, 1, 0.05F};
    EXPECT_EQ(spread(image, bloom, 0.25).rgb, image.rgb); // 3 is 0.75 there
    EXPECT_NE(spread(image, bloom, 1).rgb, image.rgb);
}

} // namespace
} // namespace froxel::reference

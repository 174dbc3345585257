#include "reference/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace froxel::reference {
namespace {

constexpr VisibleTriangle kLit{0, 0, 0};
constexpr VisibleTriangle kUnlit{0, 1, 0};
constexpr VisibleTriangle kEmpty{};

struct Pixel {
    VisibleTriangle seen;
    float grey;
};

// Of a row of grey pixels.
double factorOf(const std::vector<Pixel>& pixels) {
    scene::Scene scene;
    scene.materials.resize(2);
    scene.materials[1].unlit = true;
    scene.meshes.resize(1);
    scene.meshes[0].primitives.resize(2);
    scene.meshes[0].primitives[1].material = 1;
    scene.instances.resize(1);
    const auto width = static_cast<uint32_t>(pixels.size());
    LinearImage picture{width, 1, {}};
    Visibility visibility{width, 1, {}, {}};
    for (const Pixel& pixel : pixels) {
        picture.rgb.insert(picture.rgb.end(), 3, pixel.grey);
        visibility.pixels.push_back(pixel.seen);
    }
    return meteredFactor(scene, picture, visibility);
}

TEST(ReferenceExposure, GeometricMean_BecomesMiddleGrey) {
    EXPECT_NEAR(factorOf({{kLit, 0.18F}}), 1, 1e-6);
    EXPECT_NEAR(factorOf({{kLit, 0.25F}, {kLit, 4}, {kLit, 1}}), 0.18, 1e-6);
}

TEST(ReferenceExposure, TenthAtEitherEnd_IsLeftOut) {
    std::vector<Pixel> pixels(16, {kLit, 2});
    pixels.insert(pixels.end(), 2, {kLit, 0.001F});
    pixels.insert(pixels.end(), 2, {kLit, 60'000});
    EXPECT_NEAR(factorOf(pixels), 0.09, 1e-6);
}

TEST(ReferenceExposure, EmptyUnlitAndBlackPixels_DoNotCount) {
    EXPECT_NEAR(factorOf({{kLit, 0.18F}, {kEmpty, 50}, {kUnlit, 50}, {kLit, 0}, {kLit, 1e-6F}}), 1,
                1e-6);
    EXPECT_EQ(factorOf({{kEmpty, 50}, {kUnlit, 50}, {kLit, 0}}), 1);
}

TEST(ReferenceExposure, BeyondTenStops_StaysThere) {
    EXPECT_EQ(factorOf({{kLit, 5'000}}), std::exp2(-10));
    EXPECT_EQ(factorOf({{kLit, 1e-4F}}), std::exp2(10));
    EXPECT_EQ(factorOf({{kLit, std::numeric_limits<float>::infinity()}}), std::exp2(-10));
    EXPECT_EQ(factorOf({{kLit, std::numeric_limits<float>::quiet_NaN()}}), 1);
}

} // namespace
} // namespace froxel::reference

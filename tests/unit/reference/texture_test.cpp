// The reference's texture filter against closed forms.
#include "reference/texture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace froxel::reference {
namespace {

using scene::Filter;
using scene::Wrap;

// R of texel (x, y) is f(x, y); alpha 255.
template <class F>
scene::Image image(uint32_t width, uint32_t height, F f) {
    scene::Image out{"test", width, height, {}};
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            for (const uint32_t value : {static_cast<uint32_t>(f(x, y)), 0U, 0U, 255U}) {
                out.rgba8.own().push_back(static_cast<std::byte>(value));
            }
        }
    }
    return out;
}

scene::Sampler wrapping(Wrap wrap) {
    return {.wrap_u = wrap, .wrap_v = wrap};
}

double red(const MipChain& chain,
           const scene::Sampler& s,
           const Footprint& f,
           const TextureFilter& filter = {}) {
    return chain.sample(s, f, filter).x * 255;
}

TEST(ReferenceTexture, Srgb_AtKnownValues_IsTheStandards) {
    EXPECT_EQ(decodeSrgb(0), 0);
    EXPECT_NEAR(decodeSrgb(1), 1, 1e-15);
    EXPECT_NEAR(decodeSrgb(0.04045), 0.04045 / 12.92, 1e-15);
    EXPECT_NEAR(decodeSrgb(0.5), 0.21404114048223255, 1e-12);
    const auto half = image(1, 1, [](uint32_t, uint32_t) { return 128; });
    EXPECT_NEAR(MipChain(half, true).texel(0, 0, 0).x, 0.2158605, 1e-7);
    EXPECT_EQ(MipChain(half, true).texel(0, 0, 0).w, 1);
    EXPECT_NEAR(MipChain(half, false).texel(0, 0, 0).x, 128.0 / 255, 1e-15);
}

TEST(ReferenceTexture, Magnified_BetweenTexelCentres_IsBilinear) {
    const auto ramp = image(4, 4, [](uint32_t x, uint32_t y) { return 10 * x + 40 * y; });
    const MipChain chain(ramp, false);
    const auto s = wrapping(Wrap::kClampToEdge);
    EXPECT_NEAR(red(chain, s, {.uv = {0.5 / 4, 0.5 / 4}}), 0, 1e-12);
    EXPECT_NEAR(red(chain, s, {.uv = {2.0 / 4, 1.25 / 4}}), 10 * 1.5 + 40 * 0.75, 1e-12);
    EXPECT_NEAR(red(chain, s, {.uv = {-3, 9}}), 120, 1e-12);
}

TEST(ReferenceTexture, Wrapping_FarOutside_FollowsEachMode) {
    const auto ramp = image(4, 1, [](uint32_t x, uint32_t) { return 10 * (x + 1); });
    const MipChain chain(ramp, false);
    const auto at = [&](Wrap wrap, double texel) {
        return red(chain, wrapping(wrap), {.uv = {(texel + 0.5) / 4, 0.5}});
    };
    const std::array repeat = {30.0, 40.0, 10.0, 20.0, 30.0, 40.0, 10.0}; // texels -2 to 4
    const std::array mirrored = {20.0, 10.0, 10.0, 20.0, 30.0, 40.0, 40.0};
    for (int i = 0; i < 7; ++i) {
        const auto k = static_cast<size_t>(i);
        EXPECT_NEAR(at(Wrap::kRepeat, i - 2), repeat[k], 1e-12) << i;
        EXPECT_NEAR(at(Wrap::kMirroredRepeat, i - 2), mirrored[k], 1e-12) << i;
        EXPECT_NEAR(at(Wrap::kRepeat, i - 2 - 400), repeat[k], 1e-9) << i;
        EXPECT_NEAR(at(Wrap::kMirroredRepeat, i - 2 + 800), mirrored[k], 1e-9) << i;
    }
    EXPECT_NEAR(at(Wrap::kRepeat, -0.5), 25, 1e-12); // across the border
    EXPECT_NEAR(at(Wrap::kClampToEdge, -0.5), 10, 1e-12);
}

TEST(ReferenceTexture, MipLevels_OfEvenSizes_AreMeansOfFourDownToTheMeanOfAll) {
    const auto noise = image(8, 4, [](uint32_t x, uint32_t y) { return (x * 37 + y * 101) % 256; });
    const MipChain chain(noise, true);
    ASSERT_EQ(chain.levelCount(), 4U);
    EXPECT_EQ(chain.size(1), glm::uvec2(4, 2));
    EXPECT_EQ(chain.size(3), glm::uvec2(1, 1));
    double mean = 0;
    for (uint32_t y = 0; y < 4; ++y) {
        for (uint32_t x = 0; x < 8; ++x) {
            mean += chain.texel(0, x, y).x / 32;
        }
    }
    EXPECT_NEAR(chain.texel(3, 0, 0).x, mean, 1e-7); // in linear light
    EXPECT_NEAR(chain.texel(1, 1, 1).x,
                (chain.texel(0, 2, 2).x + chain.texel(0, 3, 2).x + chain.texel(0, 2, 3).x +
                 chain.texel(0, 3, 3).x) /
                    4,
                1e-7);
}

// Those that are given as they are, the others from the last of them.
TEST(ReferenceTexture, MipLevels_ThatAnImageGives_AreUsed) {
    auto given = image(4, 4, [](uint32_t, uint32_t) { return 200; });
    given.mips.push_back(image(2, 2, [](uint32_t x, uint32_t) { return x * 100; }).rgba8);
    const MipChain chain(given, false);
    ASSERT_EQ(chain.levelCount(), 3U);
    EXPECT_NEAR(chain.texel(1, 0, 1).x * 255, 0, 1e-5);
    EXPECT_NEAR(chain.texel(1, 1, 1).x * 255, 100, 1e-5);
    EXPECT_NEAR(chain.texel(2, 0, 0).x * 255, 50, 1e-5);
    EXPECT_NEAR(MipChain(given, true).texel(1, 1, 0).x, decodeSrgb(100.0 / 255), 1e-7);
}

// Level k of a constant-by-level picture: a checkerboard has 127.5 from level 1 on.
TEST(ReferenceTexture, Minified_BetweenLevels_IsTrilinear) {
    const auto checks = image(8, 8, [](uint32_t x, uint32_t y) { return (x + y) % 2 * 200; });
    const MipChain chain(checks, false);
    scene::Sampler s;
    const auto at = [&](double texels) { // one footprint of so many texels, at a white texel
        return Footprint{{1.5 / 8, 0.5 / 8}, {texels / 8, 0}, {0, texels / 8}};
    };
    EXPECT_NEAR(red(chain, s, at(0.5)), 200, 1e-12);
    EXPECT_NEAR(red(chain, s, at(1)), 200, 1e-12);
    EXPECT_NEAR(red(chain, s, at(2)), 100, 1e-5);
    EXPECT_NEAR(red(chain, s, at(std::sqrt(2))), 150, 1e-5);
    EXPECT_NEAR(red(chain, s, at(1e9)), 100, 1e-5);
    s.mip = Filter::kNearest;
    EXPECT_NEAR(red(chain, s, at(1.4)), 200, 1e-12);
    EXPECT_NEAR(red(chain, s, at(1.42)), 100, 1e-5);
    s.mipmapped = false;
    s.min = Filter::kNearest;
    EXPECT_NEAR(red(chain, s, at(4)), 200, 1e-12);
}

// Stripes along v seen through a footprint that is long along v: only isotropic filtering blurs.
TEST(ReferenceTexture, LongFootprint_WithAnisotropy_KeepsWhatLiesAcross) {
    const auto stripes = image(64, 64, [](uint32_t x, uint32_t) { return x % 2 * 200; });
    const MipChain chain(stripes, false);
    const scene::Sampler s;
    const Footprint f{{1.5 / 64, 0.3}, {1.0 / 64, 0}, {0, 8.0 / 64}};
    EXPECT_NEAR(red(chain, s, f), 100, 1e-5);
    EXPECT_NEAR(red(chain, s, f, {.max_anisotropy = 8}), 200, 1e-9);
}

// A white column seen through a footprint of `texels` of level 0 along u: what reaches a sample so
// far from it.
double columnAt(double texels, double distance) {
    const auto column = image(64, 64, [](uint32_t x, uint32_t) { return x == 32 ? 255 : 0; });
    const MipChain chain(column, false);
    const Footprint f{{(32.5 + distance) / 64, 0.5}, {texels / 64, 0}, {0, 1.0 / 64}};
    return red(chain, {}, f, {.max_anisotropy = 8}) / 255;
}

// Taps a texel apart, each for a texel of the footprint; the last two for what is left of it.
TEST(ReferenceTexture, Taps_OfAFootprint_CoverItsLength) {
    for (const double texels : {1.0, 1.4, 2.0, 2.5, 3.0, 4.0, 5.5, 8.0}) {
        double sum = 0;
        for (double distance = -8; distance <= 8; ++distance) {
            sum += columnAt(texels, distance + 0.25);
        }
        EXPECT_NEAR(sum, 1, 1e-12) << texels;
        EXPECT_NEAR(columnAt(texels, 0.5), texels > 1 ? 1 / std::max(texels, 2.0) : 0.5, 1e-12);
        EXPECT_EQ(columnAt(texels, std::ceil(texels / 2) + 0.51), 0) << texels;
    }
    EXPECT_NEAR(columnAt(2.5, 1.5), 0.1, 1e-12);
    EXPECT_NEAR(columnAt(1.25, 1), 0.1, 1e-12); // taps at 0.2 on both sides
    EXPECT_GT(columnAt(16, 3), 0.05);           // more than 8: blurred, two texels a tap
    EXPECT_LT(columnAt(16, 3), 0.07);
}

// Of a skewed footprint both axes count, whichever of its sides are given.
TEST(ReferenceTexture, SkewedFootprint_IsAsWideAsItsAreaOverItsLength) {
    auto levels = image(64, 64, [](uint32_t, uint32_t) { return 0; });
    for (uint32_t level = 1; level <= 6; ++level) {
        levels.mips.push_back(image(64U >> level, 64U >> level, [&](uint32_t, uint32_t) {
                                  return 40 * level;
                              }).rgba8);
    }
    const MipChain chain(levels, false);
    const auto levelOf = [&](glm::dvec2 dx, glm::dvec2 dy) {
        return red(chain, {}, {{0.5, 0.5}, dx / 64.0, dy / 64.0}, {.max_anisotropy = 8}) / 40;
    };
    EXPECT_NEAR(levelOf({4, 0}, {0, 4}), 2, 1e-6);
    EXPECT_NEAR(levelOf({16, 0}, {0, 4}), 2, 1e-6);
    EXPECT_NEAR(levelOf({16, 0}, {12, 4}), std::log2(16 * 4 / (28 + 4 * 11.0 / 32) * 16 / 11),
                1e-6);
    EXPECT_NEAR(levelOf({64, 0}, {0, 4}), 3, 1e-6); // an eighth of its length
    EXPECT_NEAR(levelOf({0, 0}, {16, 0}), 1, 1e-6);
    EXPECT_EQ(levelOf({0, 0}, {0, 0}), 0);
}

// As hardware has it: between texels and levels there are 256 steps.
TEST(ReferenceTexture, Steps_OfWeightsAndLevels_AreRoundedTo) {
    const auto edge = image(4, 1, [](uint32_t x, uint32_t) { return x > 1 ? 200 : 0; });
    const MipChain chain(edge, false);
    const TextureFilter coarse{.weight_step = 0.25, .level_step = 0.25};
    const auto s = wrapping(Wrap::kClampToEdge);
    EXPECT_EQ(red(chain, s, {{(1.5 + 0.12) / 4, 0.5}}, coarse), 0);
    EXPECT_NEAR(red(chain, s, {{(1.5 + 0.13) / 4, 0.5}}, coarse), 50, 1e-12);
    const auto checks = image(8, 8, [](uint32_t x, uint32_t y) { return (x + y) % 2 * 200; });
    const double texels = std::exp2(0.3);
    const Footprint f{{1.5 / 8, 0.5 / 8}, {texels / 8, 0}, {0, texels / 8}};
    EXPECT_NEAR(red(MipChain(checks, false), {}, f, coarse), 175, 1e-5);
}

} // namespace
} // namespace froxel::reference

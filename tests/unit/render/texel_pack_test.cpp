#include "interface/constants.h"
#include "render/texel_pack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <gmock/gmock.h>

namespace froxel::render {

namespace {

using ::testing::ElementsAre;

// An image of one value a texel: x counts along rows.
uint32_t addTexture(scene::Scene& scene, uint32_t width, uint32_t height, uint8_t step) {
    scene::Image image{"image", width, height, {}};
    for (uint32_t i = 0; i < width * height; ++i) {
        const auto value = static_cast<std::byte>(i * step);
        image.rgba8.insert(image.rgba8.end(), {value, value, value, std::byte{255}});
    }
    scene.images.push_back(std::move(image));
    scene.textures.push_back({static_cast<uint32_t>(scene.images.size() - 1), scene::kNone});
    return static_cast<uint32_t>(scene.textures.size() - 1);
}

scene::Material opaque(uint32_t color, uint32_t normal, uint32_t roughness) {
    scene::Material m;
    m.base_color_texture.texture = color;
    m.normal_texture.texture = normal;
    m.metallic_roughness_texture.texture = roughness;
    return m;
}

uint32_t greenOf(uint32_t word) {
    return word >> 11U & 2047U;
}

// As addTexture(), with a metalness of 1 all over.
uint32_t addRoughness(scene::Scene& scene, uint32_t width, uint32_t height) {
    const auto texture = addTexture(scene, width, height, 3);
    auto& bytes = scene.images.back().rgba8;
    for (size_t i = 2; i < bytes.size(); i += 4) {
        bytes[i] = std::byte{255};
    }
    return texture;
}

} // namespace

TEST(TexelPack, SlotsAlike_GoTogether) {
    scene::Scene scene;
    const auto a = addTexture(scene, 4, 4, 1);
    const auto b = addTexture(scene, 4, 4, 2);
    const auto c = addRoughness(scene, 4, 4);
    const auto plan = planPack(scene, opaque(a, b, c));
    EXPECT_TRUE(plan.color && plan.normal && plan.roughness);
    EXPECT_EQ(plan.flags(), io::kMaterialPackedColor | io::kMaterialPackedNormal |
                                io::kMaterialPackedRoughness | io::kMaterialPackedPair);
}

TEST(TexelPack, OtherSizeOrTransform_KeepsItsSampler) {
    scene::Scene scene;
    const auto a = addTexture(scene, 4, 4, 1);
    const auto small = addTexture(scene, 2, 2, 2);
    auto material = opaque(a, small, a);
    material.metallic_roughness_texture.scale = {2, 1};
    const auto plan = planPack(scene, material);
    EXPECT_TRUE(plan.color);
    EXPECT_FALSE(plan.normal);
    EXPECT_FALSE(plan.roughness);
    EXPECT_FALSE(plan.pair());
}

TEST(TexelPack, SidesNotPowersOfTwoOrOtherSampler_AreNotPacked) {
    scene::Scene scene;
    const auto odd = addTexture(scene, 3, 4, 1);
    const auto clamped = addTexture(scene, 4, 4, 1);
    scene.samplers.push_back({.wrap_u = scene::Wrap::kClampToEdge});
    scene.textures[clamped].sampler = 0;
    EXPECT_FALSE(planPack(scene, opaque(odd, scene::kNone, clamped)).any());
}

TEST(TexelPack, AlphaInUse_LeavesRoughnessItsSampler) {
    scene::Scene scene;
    const auto a = addTexture(scene, 4, 4, 1);
    auto material = opaque(a, a, addRoughness(scene, 4, 4));
    material.alpha_mode = scene::AlphaMode::kMask;
    const auto plan = planPack(scene, material);
    EXPECT_TRUE(plan.color && plan.normal && plan.alpha);
    EXPECT_FALSE(plan.roughness);
}

TEST(TexelPack, MetalnessThatVaries_KeepsItsSampler) {
    scene::Scene scene;
    const auto a = addTexture(scene, 4, 4, 1);
    EXPECT_FALSE(planPack(scene, opaque(a, a, a)).roughness);
}

TEST(TexelPack, Levels_FollowEachOtherDownToASideOfOne) {
    scene::Scene scene;
    const auto material = opaque(addTexture(scene, 8, 2, 4), scene::kNone, scene::kNone);
    const auto pack = packTexels(scene, material, planPack(scene, material));
    EXPECT_EQ(pack.log2_size, glm::uvec2(3, 1));
    EXPECT_EQ(pack.last_level, 1U);
    EXPECT_EQ(pack.words.size(), 16U + 4U);
}

TEST(TexelPack, Colors_AreGamma2OfSrgbAndAverageInLinearLight) {
    scene::Scene scene;
    scene.images.push_back({"image", 2, 2, std::vector<std::byte>(16, std::byte{255})});
    for (const size_t i : {0U, 1U, 2U, 12U, 13U, 14U}) { // the first and the last texel are black
        scene.images[0].rgba8[i] = std::byte{0};
    }
    scene.textures.push_back({0, scene::kNone});
    const auto material = opaque(0, scene::kNone, scene::kNone);
    const auto pack = packTexels(scene, material, planPack(scene, material));
    ASSERT_EQ(pack.words.size(), 5U);
    EXPECT_EQ(greenOf(pack.words[0]), 0U);
    EXPECT_EQ(greenOf(pack.words[1]), 2047U);
    // Half the light is the root of a half.
    EXPECT_EQ(greenOf(pack.words[4]), 1447U);
}

TEST(TexelPack, EveryByteOfSrgb_IsWithinHalfAStep) {
    scene::Scene scene;
    const auto material = opaque(addTexture(scene, 16, 16, 1), scene::kNone, scene::kNone);
    const auto pack = packTexels(scene, material, planPack(scene, material));
    for (uint32_t i = 0; i < 256; ++i) {
        const double c = i / 255.0;
        const double linear = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
        EXPECT_NEAR(greenOf(pack.words[i]) / 2047.0, std::sqrt(linear), 0.5 / 2047 + 1e-6);
    }
}

TEST(TexelPack, Words_HoldNormalAndRoughness) {
    scene::Scene scene;
    const auto a = addTexture(scene, 1, 1, 0);
    scene.images.push_back({"orm", 1, 1, {std::byte{1}, std::byte{2}, std::byte{3}, std::byte{4}}});
    scene.textures.push_back({1, scene::kNone});
    auto material = opaque(a, 1, 1);
    material.metallic = 0.5F;
    const auto words = packTexels(scene, material, planPack(scene, material)).words;
    EXPECT_THAT(words, ElementsAre(0U, 1U | 2U << 8U | 3U << 16U | 2U << 24U));
    EXPECT_FLOAT_EQ(packedMetalness(scene, material), 0.5F * 3 / 255);
}

} // namespace froxel::render

#include "render/steps/fog_plan.h"

#include <gtest/gtest.h>

namespace froxel::render {
namespace {

settings::ViewSettings settingsOf(const settings::Size& size) {
    settings::ViewSettings settings;
    settings.size = size;
    settings.fog.density = 0.1F;
    return settings;
}

TEST(FogPlan, Nodes_StandInThePictureAndCoverIt) {
    for (const uint32_t side : {16U, 17U, 33U, 64U, 65U, 1080U, 1281U}) {
        for (const uint32_t tile : {4U, 7U, 16U, 64U}) {
            auto settings = settingsOf({side, 16});
            settings.fog.tile_px = tile;
            const io::Fog fog = makeFog(settings, 50, 0);
            ASSERT_GE(fog.node_count_x, 2U);
            // The last but one is within the picture, the last one at its end or past it.
            EXPECT_LT((fog.node_count_x - 2) * fog.tile_px, side - 1) << side << " by " << tile;
            EXPECT_GE((fog.node_count_x - 1) * fog.tile_px, side - 1) << side << " by " << tile;
        }
    }
}

TEST(FogPlan, HalfRate_IsHalfOnEachAxis) {
    auto settings = settingsOf({640, 360});
    const io::Fog whole = makeFog(settings, 50, 0);
    settings.fog.half_rate = true;
    const io::Fog half = makeFog(settings, 50, 0);
    EXPECT_EQ(half.tile_px, 2 * whole.tile_px);
    EXPECT_EQ(half.slice_count, whole.slice_count / 2);
    EXPECT_NEAR(static_cast<double>(froxelCount(whole)) / static_cast<double>(froxelCount(half)), 8,
                1); // the border has nodes either way
}

TEST(FogPlan, SamplesOfAPixel_NeedNoMoreFroxels) {
    auto settings = settingsOf({640, 360});
    const uint64_t once = froxelCount(makeFog(settings, 50, 0));
    settings.antialiasing = settings::Antialiasing::kSsaa4;
    settings.size = {1280, 720}; // drawn
    EXPECT_EQ(froxelCount(makeFog(settings, 50, 0)), once);
}

TEST(FogPlan, Far_IsWhereLightsEndOrNothingIsLetThrough) {
    auto settings = settingsOf({640, 360});
    EXPECT_EQ(makeFog(settings, 50, 0).far_m, 50.0F);
    settings.fog.density = 4;
    EXPECT_EQ(makeFog(settings, 50, 0).far_m, 4.0F);
    settings.fog.height_falloff = 1; // thinner somewhere
    EXPECT_EQ(makeFog(settings, 50, 0).far_m, 50.0F);
}

TEST(FogPlan, Eye_IsAboveTheBase) {
    auto settings = settingsOf({640, 360});
    settings.camera.eye_world.y = 1'000'003.25;
    settings.fog.base_height_m = 1'000'001;
    EXPECT_EQ(makeFog(settings, 50, 0).eye_height_m, 2.25F);
}

TEST(FogPlan, Seed_IsOfTheTimeAlone) {
    const auto settings = settingsOf({640, 360});
    EXPECT_EQ(makeFog(settings, 50, 1.5).seed, makeFog(settings, 50, 1.5).seed);
    EXPECT_NE(makeFog(settings, 50, 1.5).seed, makeFog(settings, 50, 1.5001).seed);
}

TEST(FogPlan, TooManyFroxels_AreRefused) {
    constexpr uint64_t kTexels = uint64_t{1} << 27U;
    auto settings = settingsOf({3840, 2160});
    settings.fog.tile_px = 8;
    EXPECT_TRUE(checkFroxels(makeFog(settings, 50, 0), kTexels));
    settings.fog.slice_count = 128;
    const auto large = checkFroxels(makeFog(settings, 50, 0), kTexels);
    ASSERT_FALSE(large);
    EXPECT_EQ(large.error().code, ErrorCode::kCapacity);
    EXPECT_EQ(large.error().message,
              "fog_tile and fog_slices ask for 481x271x128 froxels, 16684928 in all; at most "
              "8388608 are allowed; use larger tiles or fewer slices");
    settings.fog.tile_px = 16;
    EXPECT_FALSE(checkFroxels(makeFog(settings, 50, 0), 65536));
}

} // namespace
} // namespace froxel::render

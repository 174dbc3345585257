#include "assign_cases.h"
#include "cluster/depth_range.h"

#include <gtest/gtest.h>

namespace froxel::cluster::testing {
namespace {

const BoundsD3 kRoom{{-10, -5, -100}, {10, 5, 20}}; // the camera looks along -Z from the origin

TEST(LitDepthRange, Lights_SetTheFar) {
    light::FrameLights lights;
    addPoint(lights, {0, 0, -30}, 4);
    addPoint(lights, {3, 0, -10}, 2);
    const DepthRange range = litDepthRange(lights, perspective(45), kRoom);
    EXPECT_GT(range.far_m, 34);
    EXPECT_LT(range.far_m, 34.01);
    EXPECT_NEAR(range.near_m, 8, 0.01); // in front of it nothing is lit
}

TEST(LitDepthRange, Scene_LimitsTheFar) {
    light::FrameLights lights;
    addPoint(lights, {0, 0, -30}, 1e4);
    EXPECT_NEAR(litDepthRange(lights, perspective(45), kRoom).far_m, 100, 0.01);
    addPoint(lights, {0, 0, 5}, kUnlimited);
    EXPECT_NEAR(litDepthRange(lights, perspective(45), kRoom).far_m, 100, 0.01);
}

// Between walls, behind them and in front of them: a medium is everywhere.
TEST(LitDepthRange, Medium_IsLitBeyondTheScene) {
    light::FrameLights lights;
    addPoint(lights, {0, 0, -30}, 100);
    EXPECT_NEAR(litDepthRange(lights, perspective(45), kRoom, Lit::kMedium).far_m, 130, 0.01);
    addPoint(lights, {0, 0, -150}, 10);
    EXPECT_NEAR(litDepthRange(lights, perspective(45), kRoom, Lit::kMedium).far_m, 160, 0.01);
    const BoundsD3 behind{{-1, -1, 5}, {1, 1, 9}};
    EXPECT_NEAR(litDepthRange(lights, perspective(45), behind, Lit::kMedium).far_m, 160, 0.01);
    EXPECT_NEAR(litDepthRange(lights, perspective(45), {}, Lit::kMedium).far_m, 160, 0.01);
}

TEST(LitDepthRange, LightsWithoutLimitInAMedium_EndWithTheScene) {
    light::FrameLights lights;
    addPoint(lights, {0, 0, -30}, 1);
    addPoint(lights, {0, 0, 5}, kUnlimited);
    EXPECT_NEAR(litDepthRange(lights, perspective(45), kRoom, Lit::kMedium).far_m, 100, 0.01);
    addPoint(lights, {0, 0, -200}, 1);
    EXPECT_NEAR(litDepthRange(lights, perspective(45), kRoom, Lit::kMedium).far_m, 201, 0.01);
}

TEST(LitDepthRange, LightsBehind_AreIgnored) {
    light::FrameLights lights;
    addPoint(lights, {0, 0, 10}, 9);
    addPoint(lights, {0, 0, -3}, 1);
    EXPECT_NEAR(litDepthRange(lights, perspective(45), kRoom).far_m, 4, 0.01);
}

TEST(LitDepthRange, AnyInput_GivesAscendingPositiveDepths) {
    std::vector<light::FrameLights> sets(6);
    addPoint(sets[1], {0, 0, 10}, 1); // behind
    addPoint(sets[2], {0, 0, 0}, kUnlimited);
    addPoint(sets[3], {0, 0, -1}, 1e-3);
    addPoint(sets[4], {0, 0, -1e15}, 1e4);
    addPoint(sets[5], {0, 0, -1e-9}, 1e-12);
    const BoundsD3 scenes[] = {kRoom, BoundsD3{}, BoundsD3{{-1, -1, 5}, {1, 1, 9}},
                               BoundsD3{{0, 0, 0}, {0, 0, 0}}};
    for (const auto& lights : sets) {
        for (const auto& scene : scenes) {
            for (const settings::Camera& camera : {perspective(45), orthographic(1)}) {
                for (const Lit what : {Lit::kSurfaces, Lit::kMedium}) {
                    const DepthRange range = litDepthRange(lights, camera, scene, what);
                    EXPECT_GT(range.near_m, 0);
                    EXPECT_LT(range.near_m, range.far_m);
                    EXPECT_TRUE(std::isfinite(range.far_m));
                }
            }
        }
    }
}

TEST(LitDepthRange, SmallLightsInALongScene_KeepNearWithinReach) {
    light::FrameLights lights;
    addPoint(lights, {0, 0, -1}, 2);
    addPoint(lights, {0, 0, -90}, 2);
    EXPECT_NEAR(litDepthRange(lights, perspective(45), kRoom).near_m, 8, 1e-6);
}

} // namespace
} // namespace froxel::cluster::testing

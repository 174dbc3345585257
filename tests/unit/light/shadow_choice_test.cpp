#include "light/light_rig.h"
#include "light/shadow_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <gmock/gmock.h>

namespace froxel::light {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// White point lights ahead of the eye at the origin, which looks along -Z.
struct Ahead {
    FrameLights lights;
    settings::Camera camera;
    settings::Size size{160, 90};

    Ahead& add(const glm::vec3& position_view, float radius_m = 1, float intensity = 1) {
        lights.lights.push_back({.position_view = position_view,
                                 .inv_radius2 = 1 / (radius_m * radius_m),
                                 .color = glm::vec3(intensity),
                                 .spot = io::kNoSpot});
        lights.radii_m.push_back(radius_m);
        return *this;
    }
    Ahead& asSpot(double outer_rad) {
        lights.lights.back().spot = static_cast<uint32_t>(lights.spots.size());
        lights.spots.push_back({});
        lights.cones.push_back({std::cos(outer_rad), std::sin(outer_rad)});
        return *this;
    }
    [[nodiscard]] std::vector<uint32_t> choose(uint32_t count) const {
        return chooseShadowed(lights, camera, size, 100, count);
    }
};

TEST(Importance, IsTheUnwindowedIrradianceAtTheEye_AndTheMeanInsideTheBall) {
    EXPECT_DOUBLE_EQ(importance(8, 4, 2, 1), 0.5);
    EXPECT_DOUBLE_EQ(importance(8, 1, 2, 1), 2);
    EXPECT_DOUBLE_EQ(importance(8, 0, 2, 0.25), 0.5);
    EXPECT_EQ(importance(8, 0, 0, 1), 0);
}

TEST(ChooseShadowed, TakesTheMostImportant_InLightOrder) {
    Ahead ahead;
    ahead.add({0, 0, -20}).add({0, 0, -5}).add({0, 0, -20}, 1, 100).add({0, 0, -30});
    EXPECT_THAT(ahead.choose(0), IsEmpty());
    EXPECT_THAT(ahead.choose(1), ElementsAre(2)); // 100 / 400 against 1 / 25
    EXPECT_THAT(ahead.choose(2), ElementsAre(1, 2));
    EXPECT_THAT(ahead.choose(3), ElementsAre(0, 1, 2));
    EXPECT_THAT(ahead.choose(32), ElementsAre(0, 1, 2, 3));
}

// More than one thread looks at.
TEST(ChooseShadowed, OfVeryMany_TheMostImportantWhereverTheyAre) {
    Ahead ahead;
    for (uint32_t i = 0; i < 100'000; ++i) {
        const bool bright = i == 3 || i == 49'999 || i == 50'000 || i == 99'999;
        ahead.add({0, 0, -20}, 1, bright ? 10.0F : 1.0F);
    }
    EXPECT_THAT(ahead.choose(4), ElementsAre(3, 49'999, 50'000, 99'999));
    // Of equals the first.
    EXPECT_THAT(ahead.choose(6), ElementsAre(0, 1, 3, 49'999, 50'000, 99'999));
}

TEST(ChooseShadowed, Rectangles_HaveNoMaps) {
    Ahead ahead;
    ahead.add({0, 0, -5}, 1, 100).asSpot(glm::radians(90.0)).add({0, 0, -6});
    ahead.lights.spots[0].area = 0;
    ahead.lights.areas.push_back({.half_right_view = {1, 0, 0},
                                  .inv_area = 0.25F,
                                  .half_up_view = {0, 1, 0},
                                  .padding0 = 0});
    EXPECT_THAT(ahead.choose(32), ElementsAre(1));
}

TEST(ChooseShadowed, OfEqualOnes_TheFirst) {
    Ahead ahead;
    ahead.add({0, 0, -5}).add({3, 0, -4}).add({-3, 0, -4}).add({0, 0, -5});
    EXPECT_THAT(ahead.choose(2), ElementsAre(0, 1));
}

TEST(ChooseShadowed, BlackUnseenOrEmptyLights_HaveNone) {
    Ahead ahead;
    ahead.add({0, 0, -5}, 1, 0).add({0, 0, 5}).add({50, 0, -5}).add({0, -50, -5});
    ahead.add({0, 0, -5}, 0);
    EXPECT_THAT(ahead.choose(8), IsEmpty());
    ahead.add({0, 0, 0.5F}); // behind the eye plane, but its ball reaches ahead
    EXPECT_THAT(ahead.choose(8), ElementsAre(5));
}

TEST(ChooseShadowed, ATileOfALargerPicture_CountsAllThatLiesAhead) {
    Ahead ahead;
    ahead.add({50, 0, -5}).add({0, 0, 5});
    EXPECT_THAT(ahead.choose(8), IsEmpty());
    ahead.camera.lens_shift = {0, 2};
    EXPECT_THAT(ahead.choose(8), ElementsAre(0));
}

TEST(ChooseShadowed, ParallelRays_RankByIntensityAlone) {
    Ahead ahead;
    ahead.camera.projection = settings::Projection::kOrthographic;
    ahead.camera.half_height_m = 3;
    ahead.add({0, 0, -1}, 1, 1).add({0, 0, -50}, 1, 2).add({0, 5, -1}, 1, 9);
    EXPECT_THAT(ahead.choose(1), ElementsAre(1));
    EXPECT_THAT(ahead.choose(8), ElementsAre(0, 1)); // the third is above the picture
}

TEST(ChooseShadowed, ASpot_CountsByTheDirectionsItShinesIn) {
    Ahead ahead;
    ahead.add({0, 0, -5}).asSpot(0.3).add({0, 0, -6});
    EXPECT_THAT(ahead.choose(1), ElementsAre(1));
    ahead.lights.lights[0].color *= 100.0F;
    EXPECT_THAT(ahead.choose(1), ElementsAre(0));
}

TEST(ChooseShadowed, LightsWithoutRange_ReachThroughTheScene) {
    Ahead ahead;
    ahead.add({0, 0, 60}, std::numeric_limits<float>::infinity());
    EXPECT_THAT(ahead.choose(1), ElementsAre(0)); // the scene reaches 100 m
}

// Of every local light: where evaluate() puts it.
TEST(LightRig, PlaceOf_IsWhereTheFrameHasIt) {
    scene::Scene scene;
    scene.bounds_world = {{-4, 0, -4}, {4, 3, 4}};
    scene::PunctualLight spot;
    spot.type = scene::LightType::kSpot;
    spot.position_world = {1, 2, -3};
    spot.direction_world = {0, -2, 0};
    spot.outer_cone_rad = 0.5;
    scene::PunctualLight sun;
    sun.type = scene::LightType::kDirectional;
    scene::PunctualLight point;
    point.position_world = {0.5, 0.25, 2};
    scene.lights = {sun, spot, sun, point};
    const LightRig rig(scene);
    settings::Lights settings;
    settings.count = 300; // more than one batch
    const settings::Camera camera = settings::lookAt({0.5, 1, 6}, {0, 1, 0}, {0, 1, 0});
    FrameLights lights;
    rig.evaluate(settings, camera, 7.25, lights);
    ASSERT_EQ(lights.lights.size(), 302U);
    for (uint32_t i = 0; i < lights.lights.size(); ++i) {
        const auto place = rig.placeOf(settings, 7.25, i);
        const glm::dvec3 view =
            glm::transpose(camera.world_from_view) * (place.position_world - camera.eye_world);
        EXPECT_LT(glm::length(view - glm::dvec3(lights.lights[i].position_view)), 1e-6) << i;
        EXPECT_EQ(place.outer_cone_rad.has_value(), i == 300);
    }
    EXPECT_EQ(rig.placeOf(settings, 7.25, 300).direction_world, glm::dvec3(0, -1, 0));
    EXPECT_EQ(rig.placeOf(settings, 7.25, 300).outer_cone_rad, 0.5);
}

} // namespace
} // namespace froxel::light

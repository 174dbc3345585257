// Seeded and scene lights found in the picture, and placed lights that stand for them.
#include "light/light_rig.h"

#include <cmath>
#include <gmock/gmock.h>

namespace froxel::light {
namespace {

using ::testing::HasSubstr;
using Of = settings::LightRef::Of;

constexpr double kTime_s = 12.5;

scene::Scene roomWithTwoLights() {
    scene::Scene scene;
    scene.bounds_world = {{-4, 0, -9}, {4, 3, -1}};
    scene::PunctualLight sun;
    sun.type = scene::LightType::kDirectional;
    scene::PunctualLight spot;
    spot.type = scene::LightType::kSpot;
    spot.position_world = {1, 1.5, -4};
    spot.direction_world = {0.6, -0.8, 0};
    spot.color = {0.5F, 2, 1};
    spot.intensity = 8;
    spot.range_m = 3;
    spot.inner_cone_rad = 0.25;
    spot.outer_cone_rad = 0.5;
    scene::PunctualLight endless;
    endless.position_world = {-1, 1.5, -4};
    scene.lights = {sun, spot, endless};
    return scene;
}

settings::ViewSettings looking(uint32_t seeded_count) {
    settings::ViewSettings settings;
    settings.camera = settings::lookAt({0.2, 1.6, 1}, {0, 1.4, -5}, {0.1, 1, 0});
    settings.size = {640, 360};
    settings.lights.count = seeded_count;
    return settings;
}

// By the definition of PickLight, through the frame's own lights.
glm::dvec2 pictureOf(const settings::ViewSettings& settings, const glm::vec3& position_view) {
    const auto& camera = settings.camera;
    const double half = camera.projection == settings::Projection::kPerspective
                            ? static_cast<double>(-position_view.z) * std::tan(camera.yfov_rad / 2)
                            : camera.half_height_m;
    return glm::dvec2(position_view) / half / glm::dvec2(640.0 / 360, 1) - camera.lens_shift;
}

FrameLights lightsOf(const LightRig& rig, const settings::ViewSettings& settings) {
    FrameLights lights;
    rig.evaluate(settings.lights, settings.camera, kTime_s, lights);
    return lights;
}

bool within(const glm::dvec2& at) {
    return std::abs(at.x) <= 1 && std::abs(at.y) <= 1;
}

TEST(LightPick, SeededLight_IsFoundWhereItIs_ThroughAnyCamera) {
    const LightRig rig(roomWithTwoLights());
    for (const int kind : {0, 1, 2}) {
        settings::ViewSettings settings = looking(12);
        settings.lights.scene_lights = false;
        if (kind == 1) {
            settings.camera.projection = settings::Projection::kOrthographic;
            settings.camera.half_height_m = 3;
        } else if (kind == 2) {
            settings.camera.lens_shift = {0.2, -0.3};
        }
        const FrameLights lights = lightsOf(rig, settings);
        uint32_t found = 0;
        for (uint32_t i = 0; i < 12; ++i) {
            const glm::dvec2 at = pictureOf(settings, lights.lights[i].position_view);
            if (!within(at)) {
                continue;
            }
            const auto picked = rig.pick(settings, kTime_s, at).value();
            EXPECT_EQ(picked.replaces, (settings::LightRef{Of::kSeed, i}));
            ++found;
        }
        EXPECT_GT(found, 4U) << kind;
    }
}

TEST(LightPick, Picked_ShinesAsWhatItStandsFor_AtItsIndex) {
    const LightRig rig(roomWithTwoLights());
    settings::ViewSettings settings = looking(12);
    const FrameLights before = lightsOf(rig, settings);
    std::vector<settings::PlacedLight> placed;
    for (const size_t i : {3U, 7U, 12U}) { // 12: the scene's spot
        const glm::dvec2 at = pictureOf(settings, before.lights[i].position_view);
        ASSERT_TRUE(within(at)) << i;
        placed.push_back(rig.pick(settings, kTime_s, at).value());
        placed.back().id = static_cast<uint32_t>(placed.size());
    }
    EXPECT_EQ(placed[2].replaces, (settings::LightRef{Of::kScene, 1}));
    settings.lights.placed = settings::PlacedLights(placed);
    const FrameLights after = lightsOf(rig, settings);
    ASSERT_EQ(after.lights.size(), before.lights.size());
    for (size_t i = 0; i < before.lights.size(); ++i) {
        SCOPED_TRACE(i);
        EXPECT_EQ(after.lights[i].inv_radius2, before.lights[i].inv_radius2);
        EXPECT_EQ(after.lights[i].spot == io::kNoSpot, before.lights[i].spot == io::kNoSpot);
        EXPECT_LT(glm::distance(after.lights[i].position_view, before.lights[i].position_view),
                  1e-6F);
        EXPECT_LT(glm::distance(after.lights[i].color, before.lights[i].color),
                  1e-6F * glm::length(before.lights[i].color));
        EXPECT_NEAR(glm::distance(rig.placeOf(settings.lights, kTime_s + 9, 7).position_world,
                                  placed[1].position_world),
                    0, 1e-12); // it stands still
    }
    EXPECT_NEAR(after.spots[0].offset, before.spots[0].offset, 1e-6);
    EXPECT_EQ(after.directionals.size(), 1U);
    // What is replaced already is not found again.
    const glm::dvec2 at = pictureOf(settings, before.lights[3].position_view);
    const auto again = rig.pick(settings, kTime_s, at);
    EXPECT_TRUE(!again || again->replaces != placed[0].replaces);
}

TEST(LightPick, WhatIsReplaced_AndNotThere_LeavesOneMore) {
    const LightRig rig(roomWithTwoLights());
    settings::ViewSettings settings = looking(5);
    settings::PlacedLight seeded;
    seeded.id = 1;
    seeded.replaces = settings::LightRef{Of::kSeed, 5};
    settings::PlacedLight of_scene;
    of_scene.id = 2;
    of_scene.replaces = settings::LightRef{Of::kScene, 2};
    settings.lights.placed = settings::PlacedLights({seeded, of_scene});
    EXPECT_EQ(lightsOf(rig, settings).lights.size(), 5U + 2 + 1);
    settings.lights.scene_lights = false;
    EXPECT_EQ(lightsOf(rig, settings).lights.size(), 5U + 2);
    settings.lights.count = 6;
    EXPECT_EQ(lightsOf(rig, settings).lights.size(), 6U + 1);
}

TEST(LightPick, ALightOfTheFile_IsPlacedAsBrightAsItIsShown) {
    scene::Scene scene = roomWithTwoLights();
    scene.lights[2].range_m = 2;
    const LightRig rig(scene);
    settings::ViewSettings settings = looking(0);
    settings.lights.scene_light_intensity = 0.5F;
    const FrameLights lights = lightsOf(rig, settings);
    const auto picked =
        rig.pick(settings, kTime_s, pictureOf(settings, lights.lights[1].position_view)).value();
    EXPECT_EQ(picked.intensity, scene.lights[2].intensity * 0.5F);
}

// The nearest has no range; the one beside it can be placed. A sun has no place to stand in.
TEST(LightPick, WhatCanBePlaced_IsPreferred_AndSunsStay) {
    scene::Scene scene = roomWithTwoLights();
    scene.lights.push_back(scene.lights[2]);
    scene.lights.back().position_world.x += 0.02;
    scene.lights.back().range_m = 2;
    const LightRig rig(scene);
    settings::ViewSettings settings = looking(0);
    const FrameLights lights = lightsOf(rig, settings);
    const auto picked =
        rig.pick(settings, kTime_s, pictureOf(settings, lights.lights[1].position_view)).value();
    EXPECT_EQ(picked.replaces, (settings::LightRef{Of::kScene, 3}));
    settings::PlacedLight sun = picked;
    sun.id = 1;
    sun.replaces = settings::LightRef{Of::kScene, 0};
    settings.lights.placed = settings::PlacedLights({sun});
    EXPECT_EQ(lightsOf(rig, settings).directionals.size(), 1U);
    EXPECT_EQ(lightsOf(rig, settings).lights.size(), 3U + 1);
}

TEST(LightPick, WhatCannotBePicked_IsToldWhy) {
    const LightRig rig(roomWithTwoLights());
    settings::ViewSettings settings = looking(0);
    const auto why = [&](const glm::dvec2& at) {
        const auto picked = rig.pick(settings, kTime_s, at);
        return picked ? "" : picked.error().message;
    };
    EXPECT_THAT(why({-0.9, 0.9}), HasSubstr("hits no light"));
    const FrameLights lights = lightsOf(rig, settings);
    EXPECT_THAT(why(pictureOf(settings, lights.lights[1].position_view)),
                HasSubstr("a light whose range is 0"));
    settings.lights.count = 20'000;
    EXPECT_THAT(why({0, 0}), HasSubstr("20003 lights"));
}

} // namespace
} // namespace froxel::light

#include "scene/enclosure.h"
#include "scene/first_look.h"
#include "unit/scene/boxes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace froxel::scene {
namespace {

TEST(CastRays, MeetTheNearestSide_AtItsDistance) {
    const Scene scene = makeRoom({10, 0, 0}, 2);
    const auto hits =
        castRays(scene, {11, 0, 0.5},
                 {{1, 0, 0}, {-1, 0, 0}, {0, 0, -1}, glm::normalize(glm::dvec3(0, 3, 4))});
    const double expected[] = {1, 3, 2.5, 1.5 / 0.8};
    for (size_t i = 0; i < hits.size(); ++i) {
        ASSERT_TRUE(hits[i].has_value()) << i;
        EXPECT_NEAR(hits[i]->distance_m, expected[i], 1e-12) << i;
        EXPECT_TRUE(hits[i]->front) << i;
    }
    const auto from_outside = castRays(scene, {20, 0, 0}, {{-1, 0, 0}, {1, 0, 0}});
    ASSERT_TRUE(from_outside[0].has_value());
    EXPECT_NEAR(from_outside[0]->distance_m, 8, 1e-12);
    EXPECT_FALSE(from_outside[0]->front);
    EXPECT_FALSE(from_outside[1].has_value());
}

TEST(IsRoom, WallsThatFaceInwards_AndNoSolidThing) {
    EXPECT_TRUE(isRoom(makeRoom({5, 6, 7}, 3)));
    EXPECT_FALSE(isRoom(makeBox({5, 6, 7}, 3)));
    EXPECT_TRUE(isRoom(makeRoom({0, 0, 0}, 3, 5))) << "a court without a roof";
    EXPECT_FALSE(isRoom(makeRoom({0, 0, 0}, 3, 2))) << "two walls";
    EXPECT_FALSE(isRoom(Scene()));
}

// A chest is hollow, and an engine has fronts all around its middle.
TEST(IsRoom, WhatIsSmallOrLined_IsNone) {
    EXPECT_TRUE(isRoom(makeRoom({0, 0, 0}, 1.75)));
    EXPECT_FALSE(isRoom(makeRoom({0, 0, 0}, 1.7))) << "a diagonal of 5.9 m";
    for (const auto& [lining, room] : {std::pair(0.25, false), std::pair(0.35, true)}) {
        Scene scene = makeRoom({0, 0, 0}, 3);
        const Scene inner = makeRoom({0, 0, 0}, 3 * lining);
        scene.instances.push_back(inner.instances[0]);
        EXPECT_EQ(isRoom(scene), room) << lining;
    }
}

TEST(IsRoom, AMirroredBox_IsTurnedInsideOut) {
    Scene scene = makeBox({0, 0, 0}, 3);
    auto& place = scene.instances[0].world_from_object;
    place[0] = -place[0];
    EXPECT_FALSE(isRoom(scene)) << "a mirror turns winding and inside alike";
    scene.materials[0].double_sided = true;
    EXPECT_FALSE(isRoom(scene)) << "a hull";
    Scene glass = makeRoom({0, 0, 0}, 3);
    glass.materials[0].alpha_mode = AlphaMode::kBlend;
    EXPECT_FALSE(isRoom(glass)) << "it is passed through";
}

TEST(IsRoom, AFlatOrBrokenPlace_HasNoInside) {
    Scene scene = makeRoom({0, 0, 0}, 3);
    scene.instances[0].world_from_object[1] = glm::dvec4(0);
    EXPECT_FALSE(isRoom(scene));
}

TEST(LookFor, AThingWithoutLights_StandsInTheStudio) {
    settings::ViewSettings settings;
    Scene thing = makeBox({0, 0, 0}, 1);
    lookFor(thing, 0, settings);
    EXPECT_EQ(settings.lights.count, 0U);
    EXPECT_EQ(settings.environment.light, settings::EnvironmentLight::kStudio);
    EXPECT_EQ(settings.exposure_mode, settings::ExposureMode::kFixed);
    thing.materials[0].unlit = true;
    lookFor(thing, 0, settings);
    EXPECT_EQ(settings.environment.light, settings::EnvironmentLight::kOff);
}

TEST(LookFor, Things_WithOrWithoutMaterialsAndLight_StandBeforeTheSameBackground) {
    settings::ViewSettings usual;
    lookFor(makeBox({0, 0, 0}, 1), 0, usual);
    Scene unlit = makeBox({0, 0, 0}, 1);
    unlit.materials[0].unlit = true;
    for (const Scene& scene : {unlit, Scene()}) {
        settings::ViewSettings settings;
        lookFor(scene, 0, settings);
        EXPECT_EQ(settings.background, usual.background);
    }
}

// And the studio, in case it is none.
TEST(LookFor, ARoom_HasAFewWhiteLampsUnderItsCeiling) {
    settings::ViewSettings settings;
    const Scene room = makeRoom({1, 2, 3}, 10);
    lookFor(room, 0, settings);
    EXPECT_EQ(settings.lights.count, 0U);
    EXPECT_EQ(settings.environment.light, settings::EnvironmentLight::kStudio);
    ASSERT_EQ(settings.lights.placed.lights().size(), 1U);
    const settings::PlacedLight lamp = settings.lights.placed.lights()[0];
    EXPECT_LT(glm::distance(lamp.position_world, glm::dvec3(1, 4.4, 3)), 1e-9);
    EXPECT_EQ(lamp.color, glm::vec3(1));
    EXPECT_GT(lamp.radius_m, 17);
    settings.lights.placed = settings::PlacedLights({lamp, {.id = 7}});
    lookFor(room, 0, settings);
    EXPECT_EQ(settings.lights.placed.lights().size(), 2U) << "somebody placed others";
}

TEST(LookFor, TheMiddleOfARoomsFloor_IsAsBrightWhateverTheNumberOfLamps) {
    for (const double side_m : {6.0, 12.0, 18.0}) {
        settings::ViewSettings settings;
        Scene room = makeRoom({0, 0, 0}, 3);
        room.instances[0].world_from_object[0] *= side_m / 6;
        room.instances[0].world_from_object[2] *= side_m / 6;
        room.bounds_world = {};
        room.bounds_world.add(glm::dvec3(-side_m / 2, -3, -side_m / 2));
        room.bounds_world.add(glm::dvec3(side_m / 2, 3, side_m / 2));
        lookFor(room, 0, settings);
        double light = 0; // below the lamp nearest to the middle
        const auto lamps = settings.lights.placed.lights();
        ASSERT_EQ(lamps.size(), static_cast<size_t>(side_m * side_m / 36));
        const glm::dvec3 floor =
            lamps[lamps.size() / 2].position_world * glm::dvec3(1, 0, 1) - glm::dvec3(0, 3, 0);
        for (const auto& lamp : lamps) {
            const glm::dvec3 up = lamp.position_world - floor;
            light += lamp.intensity * up.y / std::pow(glm::length(up), 3);
        }
        EXPECT_NEAR(light / glm::pi<double>(), 0.4, side_m == 12 ? 0.02 : 1e-6) << side_m;
    }
}

TEST(SuitsEvening, SponzaWithoutLightsOfItsOwn_Alone) {
    Scene scene = makeRoom({0, 0, 0}, 3);
    EXPECT_FALSE(suitsEvening(scene));
    scene.name = "Sponza";
    EXPECT_TRUE(suitsEvening(scene));
    scene.lights.emplace_back();
    EXPECT_FALSE(suitsEvening(scene));
}

TEST(LookFor, AHall_HasLampsAlongIt) {
    settings::ViewSettings settings;
    Scene hall = makeRoom({0, 0, 0}, 3);
    hall.instances[0].world_from_object[0] *= 5.0;
    hall.bounds_world = {};
    hall.bounds_world.add(glm::dvec3(-15, -3, -3));
    hall.bounds_world.add(glm::dvec3(15, 3, 3));
    lookFor(hall, 0, settings);
    const auto lamps = settings.lights.placed.lights();
    ASSERT_EQ(lamps.size(), 3U);
    EXPECT_LT(glm::distance(lamps[0].position_world, glm::dvec3(-10, 0.72, 0)), 1e-9);
    EXPECT_LT(glm::distance(lamps[2].position_world, glm::dvec3(10, 0.72, 0)), 1e-9);
}

TEST(LookFor, AScenesOwnLights_AreBroughtToTheUnitsOfADimmerStudio) {
    Scene room = makeRoom({0, 0, 0}, 10);
    room.lights.resize(1);
    for (const double arriving_lux : {1e-4, 1.0, 1e5}) {
        settings::ViewSettings settings;
        lookFor(room, arriving_lux, settings);
        EXPECT_EQ(settings.lights.count, 0U);
        EXPECT_TRUE(settings.lights.placed.lights().empty());
        EXPECT_EQ(settings.environment.light, settings::EnvironmentLight::kStudio);
        EXPECT_LT(settings.environment.strength, 0.5F);
        EXPECT_EQ(settings.exposure_mode, settings::ExposureMode::kFixed);
        EXPECT_EQ(settings.exposure, 1);
        const auto factor = static_cast<double>(settings.lights.scene_light_intensity);
        EXPECT_NEAR(factor * arriving_lux / glm::pi<double>(), 0.7, 1e-6) << "of white";
    }
}

TEST(LookFor, LightsThatReachNothing_LeaveTheStudioAsItIs) {
    settings::ViewSettings usual;
    Scene thing = makeBox({0, 0, 0}, 1);
    lookFor(thing, 0, usual);
    settings::ViewSettings settings;
    thing.lights.resize(1);
    lookFor(thing, 0, settings);
    EXPECT_EQ(settings, usual);
    lookFor(thing, 1e-30, settings);
    EXPECT_EQ(settings.lights.scene_light_intensity, 1e9F) << "the most that a setting may be";
}

TEST(LookFor, Sponza_KeepsItsThousandLights) {
    settings::ViewSettings settings;
    Scene sponza = makeRoom({0, 0, 0}, 10); // half diagonal 17.3 m
    sponza.name = "Sponza";
    lookFor(sponza, 0, settings);
    EXPECT_EQ(settings, settings::ViewSettings());
}

// The irradiance at a share of the reach is the same whatever the scene's size.
TEST(LookFor, SeededLights_GrowWithTheScene) {
    settings::ViewSettings usual;
    lookFor(makeRoom({0, 0, 0}, 10), 0, usual);
    for (const double k : {0.01, 0.1, 10.0, 100.0}) {
        settings::ViewSettings settings;
        lookFor(makeRoom({0, 0, 0}, 10 * k), 0, settings);
        EXPECT_NEAR(settings.lights.radius_m, usual.lights.radius_m * k, 1e-6 * k) << k;
        EXPECT_NEAR(settings.lights.intensity, usual.lights.intensity * k * k, 1e-6 * k * k) << k;
    }
}

TEST(LookFor, ReachIsARoundNumber_AndInItsRange) {
    for (const auto& [half, radius] :
         {std::pair(1e-6, 0.001), {0.5, 0.1}, {1.0, 0.2}, {2.0, 0.5}, {1e9, 1e4}}) {
        settings::ViewSettings settings;
        lookFor(makeBox({0, 0, 0}, half), 0, settings);
        EXPECT_NEAR(settings.lights.radius_m, radius, 1e-6 * radius) << half;
    }
    settings::ViewSettings settings;
    lookFor(Scene(), 0, settings);
    EXPECT_EQ(settings.lights.radius_m, settings::Lights().radius_m) << "nothing has no size";
}

} // namespace
} // namespace froxel::scene

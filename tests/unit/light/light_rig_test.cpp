#include "light/light_rig.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace froxel::light {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

scene::PunctualLight punctual(scene::LightType type) {
    scene::PunctualLight light;
    light.type = type;
    light.position_world = {1, 2, -3};
    light.direction_world = {0, -1, 0};
    light.color = {1, 0.5F, 0.25F};
    light.intensity = 4;
    return light;
}

FrameLights evaluated(const scene::Scene& scene,
                      const settings::Lights& settings,
                      const settings::Camera& camera = {}) {
    FrameLights out;
    LightRig(scene).evaluate(settings, camera, 0, out);
    return out;
}

settings::Lights noSeeded() {
    settings::Lights settings;
    settings.count = 0;
    return settings;
}

TEST(LightRig, Order_IsSeededThenSceneLights) {
    scene::Scene scene;
    scene.bounds_world = {{-1, -1, -1}, {1, 1, 1}};
    scene.lights = {punctual(scene::LightType::kDirectional), punctual(scene::LightType::kSpot),
                    punctual(scene::LightType::kPoint)};
    settings::Lights settings;
    settings.count = 3;
    const FrameLights lights = evaluated(scene, settings);
    ASSERT_EQ(lights.lights.size(), 5U);
    ASSERT_EQ(lights.radii_m.size(), 5U);
    ASSERT_EQ(lights.spots.size(), 1U);
    ASSERT_EQ(lights.cones.size(), 1U);
    ASSERT_EQ(lights.directionals.size(), 1U);
    EXPECT_EQ(lights.lights[2].spot, io::kNoSpot);
    EXPECT_EQ(lights.lights[3].spot, 0U);
    EXPECT_EQ(lights.lights[4].spot, io::kNoSpot);
    EXPECT_EQ(lights.radii_m[0], 2.0F);
    EXPECT_EQ(lights.lights[0].inv_radius2, 0.25F);
}

// Whatever its direction and roll, and through any camera.
TEST(LightRig, AreaLight_IsARectangleAcrossItsDirection) {
    settings::PlacedLight area;
    area.id = 2;
    area.kind = settings::LightKind::kArea;
    area.position_world = {1, 2, 3};
    area.width_m = 3;
    area.height_m = 0.5;
    for (const auto& direction : {glm::dvec3(0, -1, 0), glm::dvec3(0, 4, 0), glm::dvec3(1, -2, 0.5),
                                  glm::dvec3(0, 0, -1)}) {
        for (const double roll : {0.0, 30.0, -120.0}) {
            area.direction_world = direction;
            area.roll_deg = roll;
            settings::Lights settings = noSeeded();
            settings::PlacedLight before = area;
            before.id = 1;
            before.kind = settings::LightKind::kPoint;
            settings.placed = settings::PlacedLights({before, area});
            const FrameLights lights = evaluated({}, settings);
            ASSERT_EQ(lights.areas.size(), 1U);
            ASSERT_EQ(lights.spots.size(), 1U);
            EXPECT_EQ(lights.spots[0].area, 0U);
            EXPECT_EQ(lights.first_area, 1U);
            const io::AreaLight& rectangle = lights.areas[0];
            const glm::vec3 right = rectangle.half_right_view;
            const glm::vec3 up = rectangle.half_up_view;
            EXPECT_NEAR(glm::length(right), 1.5F, 1e-6F);
            EXPECT_NEAR(glm::length(up), 0.25F, 1e-6F);
            EXPECT_NEAR(rectangle.inv_area, 1 / 1.5F, 1e-6F);
            const glm::vec3 ahead = -glm::cross(right, up) / (1.5F * 0.25F);
            EXPECT_LT(glm::distance(ahead, lights.spots[0].direction_view), 1e-5F);
            if (roll == 0) { // a level width; the camera is level too
                EXPECT_NEAR(right.y, 0, 1e-6F);
            }
            if (roll == 0 && direction.x == 0) { // up and down, too
                EXPECT_NEAR(right.x, 1.5F, 1e-6F);
            }
            if (roll == 30 && direction == glm::dvec3(0, 0, -1)) { // seen along it, to the left
                EXPECT_NEAR(right.y, 0.75F, 1e-6F);
            }
            EXPECT_NEAR(extentOf(lights, lights.lights[1]), std::hypot(1.5F, 0.25F), 1e-6F);
        }
    }
}

// What a viewer places shines as a light of the scene does.
TEST(LightRig, PlacedLights_AreTheScenesOwnAndComeLast) {
    settings::PlacedLight point;
    point.id = 4;
    point.position_world = {1, 2, -3};
    point.color = {1, 0.5F, 0.25F};
    point.intensity = 4;
    point.radius_m = 3;
    settings::PlacedLight spot = point;
    spot.id = 5;
    spot.kind = settings::LightKind::kSpot;
    spot.direction_world = {0, -2, 0};
    spot.inner_cone_deg = 15;
    spot.outer_cone_deg = 30;
    scene::Scene scene;
    for (const auto type : {scene::LightType::kPoint, scene::LightType::kSpot}) {
        scene.lights.push_back(punctual(type));
        scene.lights.back().range_m = 3;
        scene.lights.back().inner_cone_rad = glm::radians(15.0);
        scene.lights.back().outer_cone_rad = glm::radians(30.0);
    }
    settings::Lights settings = noSeeded();
    settings.placed = settings::PlacedLights({point, spot});
    const FrameLights lights = evaluated(scene, settings);
    ASSERT_EQ(lights.lights.size(), 4U);
    ASSERT_EQ(lights.spots.size(), 2U);
    for (const size_t i : {0U, 1U}) {
        EXPECT_EQ(lights.lights[i].position_view, lights.lights[i + 2].position_view);
        EXPECT_EQ(lights.lights[i].color, lights.lights[i + 2].color);
        EXPECT_EQ(lights.lights[i].inv_radius2, lights.lights[i + 2].inv_radius2);
        EXPECT_EQ(lights.radii_m[i], lights.radii_m[i + 2]);
    }
    EXPECT_EQ(lights.lights[2].spot, io::kNoSpot);
    EXPECT_EQ(lights.lights[3].spot, 1U);
    EXPECT_EQ(lights.spots[0].direction_view, lights.spots[1].direction_view);
    EXPECT_EQ(lights.spots[0].scale, lights.spots[1].scale);
    settings.scene_lights = false;
    EXPECT_EQ(evaluated(scene, settings).lights.size(), 2U);
}

TEST(LightRig, SceneLightsOff_LeavesThemOut) {
    scene::Scene scene;
    scene.lights = {punctual(scene::LightType::kPoint), punctual(scene::LightType::kDirectional)};
    settings::Lights settings = noSeeded();
    settings.scene_lights = false;
    const FrameLights lights = evaluated(scene, settings);
    EXPECT_TRUE(lights.lights.empty());
    EXPECT_TRUE(lights.directionals.empty());
}

TEST(LightRig, SceneLightIntensity_ScalesTheFilesLightsAlone) {
    scene::Scene scene;
    scene.lights = {punctual(scene::LightType::kPoint), punctual(scene::LightType::kDirectional)};
    settings::Lights settings = noSeeded();
    settings::PlacedLight placed;
    placed.id = 1;
    settings.placed = settings::PlacedLights({placed});
    const FrameLights usual = evaluated(scene, settings);
    settings.scene_light_intensity = 0.25F;
    const FrameLights dimmed = evaluated(scene, settings);
    ASSERT_EQ(dimmed.lights.size(), 2U);
    EXPECT_EQ(dimmed.lights[0].color, usual.lights[0].color * 0.25F);
    EXPECT_EQ(dimmed.directionals[0].color, usual.directionals[0].color * 0.25F);
    EXPECT_EQ(dimmed.lights[1].color, usual.lights[1].color) << "placed";
    scene.lights[0].intensity = 3e38F;
    scene.lights[0].color = {1, 0, 0};
    settings.scene_light_intensity = 1e9F;
    EXPECT_EQ(evaluated(scene, settings).lights[0].color,
              glm::vec3(std::numeric_limits<float>::max(), 0, 0));
}

TEST(LightRig, Range_SetsTheRadius) {
    scene::Scene scene;
    scene.lights = {punctual(scene::LightType::kPoint), punctual(scene::LightType::kPoint)};
    scene.lights[1].range_m = 10;
    const FrameLights lights = evaluated(scene, noSeeded());
    EXPECT_EQ(lights.lights[0].inv_radius2, 0.0F);
    EXPECT_EQ(lights.radii_m[0], std::numeric_limits<float>::infinity());
    EXPECT_FLOAT_EQ(lights.lights[1].inv_radius2, 0.01F);
    EXPECT_EQ(lights.radii_m[1], 10.0F);
    EXPECT_EQ(lights.lights[0].color, glm::vec3(4, 2, 1));
}

TEST(LightRig, PositionsAndDirections_AreInViewSpace) {
    scene::Scene scene;
    scene.lights = {punctual(scene::LightType::kSpot), punctual(scene::LightType::kDirectional)};
    // Looking along +X: view's right is world's +Z, its back -X.
    const auto camera = settings::lookAt({-9, 2, -3}, {0, 2, -3}, {0, 1, 0});
    scene.lights[0].direction_world = {3, 0, 0};
    scene.lights[1].direction_world = {0, -1e-9, 0};
    const FrameLights lights = evaluated(scene, noSeeded(), camera);
    EXPECT_LT(glm::distance(lights.lights[0].position_view, glm::vec3(0, 0, -10)), 1e-6F);
    EXPECT_LT(glm::distance(lights.spots[0].direction_view, glm::vec3(0, 0, -1)), 1e-6F);
    EXPECT_LT(glm::distance(lights.directionals[0].direction_view, glm::vec3(0, -1, 0)), 1e-6F);
}

TEST(LightRig, SpotFalloff_GoesFromInnerToOuter) {
    scene::Scene scene;
    for (const double outer : {0.3, 0.8, 1.5}) {
        scene.lights.push_back(punctual(scene::LightType::kSpot));
        scene.lights.back().inner_cone_rad = outer / 2;
        scene.lights.back().outer_cone_rad = outer;
    }
    const FrameLights lights = evaluated(scene, noSeeded());
    for (size_t i = 0; i < lights.spots.size(); ++i) {
        const io::Spot& spot = lights.spots[i];
        const double outer = scene.lights[i].outer_cone_rad;
        const auto falloff = [&](double angle) {
            return std::cos(angle) * static_cast<double>(spot.scale) +
                   static_cast<double>(spot.offset);
        };
        EXPECT_NEAR(falloff(outer / 2), 1, 1e-5);
        EXPECT_NEAR(falloff(outer), 0, 1e-5);
        EXPECT_DOUBLE_EQ(lights.cones[i].cos_outer, std::cos(outer));
        EXPECT_DOUBLE_EQ(lights.cones[i].sin_outer, std::sin(outer));
    }
}

TEST(LightRig, SpotWithEqualCones_IsFinite) {
    scene::Scene scene;
    scene.lights = {punctual(scene::LightType::kSpot), punctual(scene::LightType::kSpot)};
    scene.lights[0].inner_cone_rad = scene.lights[0].outer_cone_rad = 0.5;
    scene.lights[1].inner_cone_rad = scene.lights[1].outer_cone_rad = 0;
    for (const io::Spot& spot : evaluated(scene, noSeeded()).spots) {
        EXPECT_NEAR(spot.scale, 1000, 0.1);
        EXPECT_TRUE(std::isfinite(spot.offset));
    }
}

TEST(LightRig, UnusableSceneLights_AreLeftOut) {
    scene::Scene scene;
    scene.lights.assign(8, punctual(scene::LightType::kSpot));
    scene.lights[0].position_world.x = std::nan("");
    scene.lights[1].intensity = std::numeric_limits<float>::infinity();
    scene.lights[2].color.y = std::nanf("");
    scene.lights[3].direction_world = {0, 0, 0};
    scene.lights[4].range_m = -1;
    scene.lights[5].outer_cone_rad = kInfinity;
    scene.lights[6].direction_world.z = kInfinity;
    EXPECT_EQ(evaluated(scene, noSeeded()).lights.size(), 1U);
}

// By its number in the file, whatever was left out before it.
TEST(LightRig, PlacedSceneLight_StandsElsewhere) {
    scene::Scene scene;
    scene.lights.assign(3, punctual(scene::LightType::kSpot));
    scene.lights[0].intensity = std::numeric_limits<float>::infinity();
    LightRig rig(scene);
    rig.place(0, {9, 9, 9}, {1, 0, 0});
    rig.place(2, {4, 5, 6}, {0, 0, 1});
    FrameLights lights;
    rig.evaluate(noSeeded(), {}, 0, lights);
    ASSERT_EQ(lights.lights.size(), 2U);
    EXPECT_EQ(lights.lights[0].position_view, glm::vec3(1, 2, -3));
    EXPECT_EQ(lights.lights[1].position_view, glm::vec3(4, 5, 6));
    EXPECT_EQ(rig.placeOf(noSeeded(), 0, 0).direction_world, glm::dvec3(0, -1, 0));
    EXPECT_EQ(rig.placeOf(noSeeded(), 0, 1).direction_world, glm::dvec3(0, 0, 1));
}

TEST(LightRig, ExtremeSceneLights_StayFinite) {
    scene::Scene scene;
    scene.lights.assign(3, punctual(scene::LightType::kPoint));
    scene.lights[0].position_world = {1e300, -1e300, 1e300};
    scene.lights[1].range_m = 1e-30F;
    scene.lights[2].intensity = 3e38F;
    scene.lights[2].color = {3e38F, 0, 1};
    for (const io::Light& light : evaluated(scene, noSeeded()).lights) {
        for (int i = 0; i < 3; ++i) {
            EXPECT_TRUE(std::isfinite(light.position_view[i]));
            EXPECT_TRUE(std::isfinite(light.color[i]));
        }
        const float distance2 = glm::dot(light.position_view, light.position_view);
        EXPECT_TRUE(std::isfinite(distance2));
        EXPECT_TRUE(std::isfinite(light.inv_radius2));
    }
}

TEST(LightRig, SeededBox_IsTheSettingsOrTheShrunkScene) {
    scene::Scene scene;
    scene.bounds_world = {{0, 0, 0}, {100, 10, 50}};
    settings::Lights settings;
    const LightRig rig(scene);
    EXPECT_LT(glm::distance(rig.seededSpace(settings).box_world.min, glm::dvec3(4, 0.4, 2)), 1e-9);
    EXPECT_LT(glm::distance(rig.seededSpace(settings).box_world.max, glm::dvec3(96, 9.6, 48)),
              1e-9);
    settings.box = BoundsD3{{-1, -2, -3}, {4, 5, 6}};
    EXPECT_EQ(rig.seededSpace(settings).box_world.min, glm::dvec3(-1, -2, -3));
    EXPECT_EQ(rig.seededSpace(settings).box_world.max, glm::dvec3(4, 5, 6));
}

TEST(LightRig, EmptyScene_HasFiniteLights) {
    settings::Lights settings;
    settings.count = 10;
    for (const io::Light& light : evaluated(scene::Scene{}, settings).lights) {
        EXPECT_EQ(light.position_view, glm::vec3(0));
    }
}

TEST(LightRig, ReusedBuffers_HoldNothingOfTheFrameBefore) {
    scene::Scene scene;
    scene.lights = {punctual(scene::LightType::kSpot), punctual(scene::LightType::kDirectional)};
    const LightRig rig(scene);
    settings::Lights settings;
    settings.count = 100;
    FrameLights lights;
    rig.evaluate(settings, {}, 1, lights);
    settings.count = 5;
    rig.evaluate(settings, {}, 1, lights);
    EXPECT_EQ(lights.lights.size(), 6U);
    EXPECT_EQ(lights.radii_m.size(), 6U);
    EXPECT_EQ(lights.spots.size(), 1U);
    EXPECT_EQ(lights.directionals.size(), 1U);
}

TEST(LightRig, EvaluationInParts_IsTheWhole) {
    scene::Scene scene;
    scene.bounds_world = {{-5, 0, -5}, {5, 3, 5}};
    scene::PunctualLight sun;
    sun.type = scene::LightType::kDirectional;
    scene.lights = {sun, scene::PunctualLight()};
    const LightRig rig(scene);
    settings::Lights settings;
    settings.count = 1000;
    settings.scene_lights = true;
    settings.cutoff = 0.01F;
    FrameLights whole;
    rig.evaluate(settings, {}, 2.5, whole);
    FrameLights parts;
    LightRig::Evaluation evaluation(rig, settings, {}, 2.5, parts);
    int steps = 1;
    while (!evaluation.advance(300)) {
        ++steps;
    }
    EXPECT_EQ(steps, 4);
    ASSERT_EQ(parts.lights.size(), whole.lights.size());
    EXPECT_EQ(0, std::memcmp(parts.lights.data(), whole.lights.data(),
                             whole.lights.size() * sizeof(io::Light)));
    EXPECT_EQ(parts.radii_m, whole.radii_m);
    EXPECT_EQ(parts.directionals.size(), 1U);
}

} // namespace
} // namespace froxel::light

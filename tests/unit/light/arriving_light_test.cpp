#include "core/math.h"
#include "light/arriving_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace froxel::light {
namespace {

// A floor of 2 x 2 m about the origin, facing up.
scene::Scene floorScene() {
    scene::Primitive floor;
    floor.positions = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
    floor.indices = {0, 1, 2, 0, 2, 3};
    scene::Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back({"", {floor}});
    scene.instances.emplace_back();
    scene.bounds_world.add(glm::dvec3(-1, 0, -1));
    scene.bounds_world.add(glm::dvec3(1, 0, 1));
    return scene;
}

scene::PunctualLight sun(float lux, const glm::dvec3& direction) {
    scene::PunctualLight light;
    light.type = scene::LightType::kDirectional;
    light.intensity = lux;
    light.direction_world = direction;
    return light;
}

TEST(ArrivingLight, OfASun_IsItsIlluminanceTimesTheCosine) {
    scene::Scene scene = floorScene();
    EXPECT_EQ(arrivingLight(scene), 0);
    scene.lights.push_back(sun(3, {0, -1, 0}));
    EXPECT_NEAR(arrivingLight(scene), 3, 1e-9);
    scene.lights[0].direction_world = glm::normalize(glm::dvec3(std::sqrt(3.0), -1, 0));
    EXPECT_NEAR(arrivingLight(scene), 1.5, 1e-9);
    scene.lights.push_back(sun(1e5F, {0, 1, 0})); // from below
    EXPECT_NEAR(arrivingLight(scene), 1.5, 1e-9);
}

TEST(ArrivingLight, GoesByNoMaterial_ButUnlitOnesGetNone) {
    scene::Scene scene = floorScene();
    scene.lights.push_back(sun(3, {0, -1, 0}));
    scene.materials[0].base_color = glm::vec4(0.03F, 0.03F, 0.03F, 1);
    EXPECT_NEAR(arrivingLight(scene), 3, 1e-9);
    scene.materials[0].unlit = true;
    EXPECT_EQ(arrivingLight(scene), 0);
}

TEST(ArrivingLight, FromBehind_LightsTwoSidedSurfacesAlone) {
    scene::Scene scene = floorScene();
    scene.lights.push_back(sun(3, {0, 1, 0}));
    EXPECT_EQ(arrivingLight(scene), 0);
    scene.materials[0].double_sided = true;
    EXPECT_NEAR(arrivingLight(scene), 3, 1e-9);
}

TEST(ArrivingLight, OfALampFarAbove_FallsByTheSquareOfItsDistance_AndEndsAtItsRange) {
    scene::Scene scene = floorScene();
    scene::PunctualLight lamp;
    lamp.position_world = {0, 100, 0};
    lamp.intensity = 500;
    scene.lights.push_back(lamp);
    EXPECT_NEAR(arrivingLight(scene), 0.05, 1e-5);
    scene.lights[0].range_m = 200;
    EXPECT_NEAR(arrivingLight(scene), 0.05 * std::pow(1 - std::pow(0.5, 4), 2), 1e-5);
    scene.lights[0].range_m = 99;
    EXPECT_EQ(arrivingLight(scene), 0);
}

TEST(ArrivingLight, OfASpot_IsWithinItsCone) {
    scene::Scene scene = floorScene();
    scene::PunctualLight spot;
    spot.type = scene::LightType::kSpot;
    spot.position_world = {0, 100, 0};
    spot.direction_world = {0, -1, 0};
    spot.intensity = 500;
    scene.lights.push_back(spot);
    EXPECT_NEAR(arrivingLight(scene), 0.05, 1e-5);
    scene.lights[0].direction_world = {0, 1, 0};
    EXPECT_EQ(arrivingLight(scene), 0);
}

// A small lamp over a wide floor leaves most of it dark; the part that it is there for counts.
TEST(ArrivingLight, IsThatOfTheBrighterHalf) {
    scene::Scene scene = floorScene();
    scene.lights.push_back(sun(8, {0, -1, 0}));
    glm::dmat4 upright(1); // turned by 60 degrees about x: half as much light
    upright[1] = {0, 0.5, std::sqrt(0.75), 0};
    upright[2] = {0, -std::sqrt(0.75), 0.5, 0};
    scene.instances.push_back({0, upright, ""});
    EXPECT_NEAR(arrivingLight(scene), 8, 1e-9);
}

TEST(ArrivingLight, OfLightsThatNoFrameHas_IsNone) {
    scene::Scene scene = floorScene();
    scene.lights.push_back(sun(std::numeric_limits<float>::quiet_NaN(), {0, -1, 0}));
    scene.lights.push_back(sun(3, {0, 0, 0}));
    EXPECT_EQ(arrivingLight(scene), 0);
    scene.lights.push_back(sun(3, {0, -1, 0}));
    EXPECT_NEAR(arrivingLight(scene), 3, 1e-9);
}

} // namespace
} // namespace froxel::light

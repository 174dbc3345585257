#include "light/light_places.h"
#include "light/light_rig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace froxel::light {
namespace {

// Corners of a triangle in object space; as an instance of its own.
void addTriangle(scene::Scene& scene,
                 const std::array<glm::vec3, 3>& corners,
                 const glm::dmat4& world_from_object = glm::dmat4(1)) {
    scene::Primitive primitive;
    primitive.positions.assign(corners.begin(), corners.end());
    primitive.indices = {0, 1, 2};
    scene.meshes.push_back({"", {primitive}});
    scene.instances.push_back(
        {static_cast<uint32_t>(scene.meshes.size() - 1), world_from_object, ""});
    for (const glm::vec3& corner : corners) {
        scene.bounds_world.add(glm::dvec3(world_from_object * glm::dvec4(corner, 1)));
    }
}

// Faces up, with an area of `size`^2 / 2.
std::array<glm::vec3, 3> floorOf(float size) {
    return {glm::vec3(0), glm::vec3(0, 0, size), glm::vec3(size, 0, 0)};
}

scene::Scene twoFloors() {
    scene::Scene scene;
    addTriangle(scene, floorOf(1));
    glm::dmat4 above(1);
    above[3] = glm::dvec4(0, 10, 0, 1);
    addTriangle(scene, floorOf(2), above);
    return scene;
}

TEST(LightPlaces, AreOnSurfaces_EvenlyByArea) {
    const auto places = lightPlaces(twoFloors());
    ASSERT_EQ(places.size(), kLightPlaces);
    size_t low = 0;
    glm::dvec3 sum{0};
    for (const LightPlace& place : places) {
        ASSERT_EQ(place.normal_world, glm::dvec3(0, 1, 0));
        const glm::dvec3& at = place.position_world;
        ASSERT_TRUE(at.y == 0 || at.y == 10);
        const double size = at.y == 0 ? 1 : 2;
        ASSERT_GE(std::min(at.x, at.z), 0);
        ASSERT_LE(at.x + at.z, size + 1e-12);
        low += at.y == 0 ? 1 : 0;
        sum += at / size;
    }
    EXPECT_NEAR(static_cast<double>(low) / kLightPlaces, 0.2, 2.0 / kLightPlaces);
    EXPECT_NEAR(sum.x / kLightPlaces, 1.0 / 3, 0.01); // the middle of a triangle
    EXPECT_NEAR(sum.z / kLightPlaces, 1.0 / 3, 0.01);
}

TEST(LightPlaces, SurfacesThatFaceDown_HaveNone_HoweverTheyAreTurned) {
    scene::Scene scene;
    addTriangle(scene, floorOf(1));
    auto ceiling = floorOf(1);
    std::swap(ceiling[1], ceiling[2]);
    glm::dmat4 above(1);
    above[3] = glm::dvec4(0, 3, 0, 1);
    addTriangle(scene, ceiling, above);
    glm::dmat4 mirrored(1); // upside down: the ceiling is a floor
    mirrored[1] = glm::dvec4(0, -1, 0, 0);
    mirrored[3] = glm::dvec4(0, 6, 0, 1);
    addTriangle(scene, ceiling, mirrored);
    for (const LightPlace& place : lightPlaces(scene)) {
        ASSERT_NE(place.position_world.y, 3);
        ASSERT_EQ(place.normal_world, glm::dvec3(0, 1, 0)) << place.position_world.y;
    }
}

TEST(LightPlaces, NothingToStandOn_HasNone) {
    EXPECT_TRUE(lightPlaces({}).empty());
    scene::Scene scene;
    addTriangle(scene, {glm::vec3(1), glm::vec3(1), glm::vec3(2)});
    addTriangle(scene, floorOf(std::numeric_limits<float>::infinity()));
    EXPECT_TRUE(lightPlaces(scene).empty());
}

// It is looked for only later.
TEST(LightPlaces, FaultsOfAScene_ArePassedOver) {
    scene::Scene scene = twoFloors();
    addTriangle(scene, floorOf(1));
    scene.meshes.back().primitives[0].indices[1] = 3;
    addTriangle(scene, {glm::vec3(0), glm::vec3(std::nanf("")), glm::vec3(1)});
    addTriangle(scene, floorOf(1));
    scene.instances.back().mesh = 99;
    EXPECT_EQ(lightPlaces(scene).size(), kLightPlaces);
}

settings::Lights atSurfaces(uint32_t count) {
    settings::Lights settings;
    settings.count = count;
    settings.places = settings::LightPlaces::kSurfaces;
    settings.radius_m = 2;
    return settings;
}

std::vector<io::Light>
lightsOf(const scene::Scene& scene, const settings::Lights& settings, double time_s) {
    FrameLights lights;
    LightRig(scene).evaluate(settings, {}, time_s, lights); // the eye is the world's origin
    return lights.lights;
}

TEST(LightPlaces, Lights_HoverJustOffThem_AndMove) {
    const auto settings = atSurfaces(3000);
    const auto first = lightsOf(twoFloors(), settings, 0);
    for (const double time_s : {0.0, 7.0, 1e6}) {
        const auto lights = lightsOf(twoFloors(), settings, time_s);
        size_t low = 0;
        for (size_t i = 0; i < lights.size(); ++i) {
            const glm::vec3& at = lights[i].position_view;
            const bool of_lower = at.y < 5;
            low += of_lower ? 1 : 0;
            const float above = of_lower ? at.y : at.y - 10;
            ASSERT_GT(above, 0.199F); // 0.25 of the radius less half a box of 0.3
            ASSERT_LT(above, 0.801F);
            ASSERT_LT(glm::distance(at, first[i].position_view), 0.6F * std::sqrt(3.0F) + 1e-4F);
        }
        EXPECT_NEAR(static_cast<double>(low) / 3000, 0.2, 0.03);
    }
    const auto soon = lightsOf(twoFloors(), settings, 0.01);
    float farthest = 0;
    for (size_t i = 0; i < soon.size(); ++i) {
        farthest = std::max(farthest, glm::distance(soon[i].position_view, first[i].position_view));
    }
    EXPECT_NEAR(farthest, 0.01F * 0.25F * 1.5F, 5e-4F); // a quarter of the speed elsewhere
    const auto later = lightsOf(twoFloors(), settings, 0.5);
    EXPECT_TRUE(
        std::equal(first.begin(), first.end(), later.begin(), [](const auto& a, const auto& b) {
            return a.position_view != b.position_view && a.color == b.color;
        }));
}

TEST(LightPlaces, InABoxOfTheSettings_AreThoseWithinIt) {
    auto settings = atSurfaces(500);
    settings.box = BoundsD3{{-1, 9, -1}, {3, 11, 3}};
    for (const io::Light& light : lightsOf(twoFloors(), settings, 3)) {
        ASSERT_GT(light.position_view.y, 10);
    }
    settings.box = BoundsD3{{-1, 4, -1}, {3, 5, 3}}; // none there: all over it
    for (const io::Light& light : lightsOf(twoFloors(), settings, 3)) {
        ASSERT_GE(light.position_view.y, 4);
        ASSERT_LE(light.position_view.y, 5);
    }
}

TEST(LightPlaces, SceneWithoutSurfaces_HasLightsAllTheSame) {
    for (const io::Light& light : lightsOf({}, atSurfaces(10), 1)) {
        EXPECT_EQ(light.position_view, glm::vec3(0));
    }
}

} // namespace
} // namespace froxel::light

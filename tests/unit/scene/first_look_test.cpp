#include "scene/enclosure.h"
#include "scene/first_look.h"

#include <gtest/gtest.h>

#include <cmath>

namespace froxel::scene {
namespace {

// A box from -half to half about `middle`, whose sides face outwards; `sides` of them, the ceiling
// last.
Scene makeBox(const glm::dvec3& middle, double half, uint32_t sides = 6) {
    Primitive box;
    // x, x, y (the floor), z, z, y (the ceiling)
    const std::array<std::pair<int, int>, 6> order = {
        {{0, -1}, {0, 1}, {1, -1}, {2, -1}, {2, 1}, {1, 1}}};
    for (uint32_t side = 0; side < sides; ++side) {
        const auto [axis, sign] = order[side];
        glm::vec3 out(0);
        glm::vec3 right(0);
        out[axis] = static_cast<float>(sign);
        right[(axis + 1) % 3] = 1;
        const glm::vec3 up = glm::cross(out, right);
        const auto first = static_cast<uint32_t>(box.positions.size());
        for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
            box.positions.push_back(out + corner.x * right + corner.y * up);
            box.bounds.add(box.positions.back());
        }
        for (const uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
            box.indices.push_back(first + corner);
        }
    }
    Scene scene;
    scene.materials.resize(1);
    scene.meshes = {{"box", {box}}};
    glm::dmat4 place(half);
    place[3] = glm::dvec4(middle, 1);
    scene.instances.push_back({0, place, ""});
    scene.bounds_world.add(middle - half);
    scene.bounds_world.add(middle + half);
    return scene;
}

// The same box, seen from inside.
Scene makeRoom(const glm::dvec3& middle, double half, uint32_t sides = 6) {
    Scene scene = makeBox(middle, half, sides);
    auto& indices = scene.meshes[0].primitives[0].indices;
    for (size_t i = 0; i < indices.size(); i += 3) {
        std::swap(indices[i], indices[i + 1]);
    }
    return scene;
}

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
    lookFor(thing, settings);
    EXPECT_EQ(settings.lights.count, 0U);
    EXPECT_EQ(settings.environment.light, settings::EnvironmentLight::kStudio);
    EXPECT_EQ(settings.exposure_mode, settings::ExposureMode::kFixed);
    thing.materials[0].unlit = true;
    lookFor(thing, settings);
    EXPECT_EQ(settings.environment.light, settings::EnvironmentLight::kOff);
}

TEST(LookFor, ARoom_KeepsItsSeededLights_UnlessItHasItsOwn) {
    const settings::ViewSettings usual;
    settings::ViewSettings settings;
    Scene room = makeRoom({0, 0, 0}, 10); // half diagonal 17.3 m
    lookFor(room, settings);
    EXPECT_EQ(settings, usual);
    room.lights.resize(1);
    lookFor(room, settings);
    EXPECT_EQ(settings.lights.count, 0U);
    EXPECT_EQ(settings.environment.light, settings::EnvironmentLight::kOff);
    EXPECT_EQ(settings.exposure_mode, settings::ExposureMode::kFrame);
}

// The irradiance at a share of the reach is the same whatever the scene's size.
TEST(LookFor, SeededLights_GrowWithTheScene) {
    settings::ViewSettings usual;
    lookFor(makeRoom({0, 0, 0}, 10), usual);
    for (const double k : {0.01, 0.1, 10.0, 100.0}) {
        settings::ViewSettings settings;
        lookFor(makeRoom({0, 0, 0}, 10 * k), settings);
        EXPECT_NEAR(settings.lights.radius_m, usual.lights.radius_m * k, 1e-6 * k) << k;
        EXPECT_NEAR(settings.lights.intensity, usual.lights.intensity * k * k, 1e-6 * k * k) << k;
    }
}

TEST(LookFor, ReachIsARoundNumber_AndInItsRange) {
    for (const auto& [half, radius] :
         {std::pair(1e-6, 0.001), {0.5, 0.1}, {1.0, 0.2}, {2.0, 0.5}, {1e9, 1e4}}) {
        settings::ViewSettings settings;
        lookFor(makeBox({0, 0, 0}, half), settings);
        EXPECT_NEAR(settings.lights.radius_m, radius, 1e-6 * radius) << half;
    }
    settings::ViewSettings settings;
    lookFor(Scene(), settings);
    EXPECT_EQ(settings.lights.radius_m, settings::Lights().radius_m) << "nothing has no size";
}

} // namespace
} // namespace froxel::scene

#include "scene/enclosing_sphere.h"
#include "scene/enclosure.h"
#include "scene/first_view.h"
#include "unit/scene/boxes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace froxel::scene {
namespace {

constexpr settings::Size kSize{160, 90};

NamedCamera looking(const char* name, const glm::dvec3& from, const glm::dvec3& at) {
    return {name, settings::lookAt(from, at, {0, 1, 0})};
}

TEST(FirstView, IsTheFirstCameraThatSeesAnything) {
    Scene scene = makeBox({0, 0, 0}, 1);
    scene.cameras = {looking("away", {0, 0, 5}, {0, 0, 9}), looking("at it", {0, 0, 5}, {0, 0, 0}),
                     looking("too", {0, 0, 6}, {0, 0, 0})};
    const FirstView view = firstViewOf(scene, {});
    EXPECT_EQ(view.scene_camera, 1U);
    EXPECT_EQ(view.cameraFor(kSize), scene.cameras[1].camera);
    ASSERT_TRUE(view.remark.has_value());
    EXPECT_EQ(view.remark->message,
              "camera 'away' sees nothing of the scene; another view is shown first");
    scene.cameras.erase(scene.cameras.begin());
    EXPECT_FALSE(firstViewOf(scene, {}).remark.has_value());
}

TEST(FirstView, WithCamerasThatSeeNothing_IsOfTheWhole) {
    Scene scene = makeBox({0, 0, 0}, 1);
    scene.cameras = {looking("away", {0, 0, 5}, {0, 0, 9})};
    const settings::Sphere sphere{{0, 0, 0}, 2};
    const FirstView view = firstViewOf(scene, sphere);
    EXPECT_EQ(view.scene_camera, std::nullopt);
    EXPECT_EQ(view.cameraFor(kSize), settings::overview(sphere, 160.0 / 90));
    EXPECT_TRUE(view.remark.has_value());
}

TEST(FirstView, OfFacesThatAllLookDown_IsFromBelow) {
    Scene scene = makeBox({0, 0, 0}, 1);
    auto& indices = scene.meshes[0].primitives[0].indices;
    indices.assign(indices.begin() + 12, indices.begin() + 18); // the floor, seen from below
    const FirstView view = firstViewOf(scene, {{0, 0, 0}, 2});
    EXPECT_LT(view.cameraFor(kSize).eye_world.y, 0);
    EXPECT_TRUE(view.remark.has_value());
    scene.materials[0].double_sided = true;
    const FirstView usual = firstViewOf(scene, {{0, 0, 0}, 2});
    EXPECT_GT(usual.cameraFor(kSize).eye_world.y, 0);
    EXPECT_FALSE(usual.remark.has_value());
}

TEST(FirstView, OfARoom_IsFromWithinAtEyeHeightAlongIt) {
    Scene hall = makeRoom({0, 0, 0}, 3);
    hall.instances[0].world_from_object[2] *= 5.0;
    hall.bounds_world = {};
    hall.bounds_world.add(glm::dvec3(-3, -3, -15));
    hall.bounds_world.add(glm::dvec3(3, 3, 15));
    const settings::Camera camera = firstViewOf(hall, {}).cameraFor(kSize);
    EXPECT_NEAR(camera.eye_world.y, -3 + 1.6, 1e-9);
    EXPECT_NEAR(std::abs(camera.eye_world.z), 12, 0.1);
    EXPECT_GT(-camera.world_from_view[2].z * -camera.eye_world.z, 10) << "towards the other end";
    EXPECT_NEAR(camera.world_from_view[2].y, 0, 1e-9);
}

// A room of 8 x 2.7 x 6 m with a table in its middle, drawn in that unit.
Scene furnishedRoom(double unit_m) {
    Scene room = makeRoom({0, 0, 0}, 1);
    const Scene table = makeBox({0, 0, 0}, 1);
    const double scale = 1 / unit_m;
    room.meshes.push_back(table.meshes[0]);
    room.instances.push_back(table.instances[0]);
    room.instances[1].mesh = 1;
    const auto place = [&](Instance& instance, const glm::dvec3& middle_m,
                           const glm::dvec3& half_m) {
        for (int axis = 0; axis < 3; ++axis) {
            instance.world_from_object[axis] = glm::dvec4(0);
            instance.world_from_object[axis][axis] = half_m[axis] * scale;
        }
        instance.world_from_object[3] = glm::dvec4(middle_m * scale, 1);
    };
    place(room.instances[0], {0, 1.35, 0}, {4, 1.35, 3});
    place(room.instances[1], {0, 0.375, 0}, {0.8, 0.375, 0.5});
    room.bounds_world = {};
    room.bounds_world.add(glm::dvec3(-4, 0, -3) * scale);
    room.bounds_world.add(glm::dvec3(4, 2.7, 3) * scale);
    return room;
}

TEST(FirstView, OfAFurnishedRoom_IsTheSameInAnyUnit_AndDoesNotStandOnTheTable) {
    for (const double unit_m : {1.0, 0.01, 0.0254, 0.001}) {
        const Scene room = furnishedRoom(unit_m);
        const settings::Camera camera = firstViewOf(room, {}).cameraFor(kSize);
        const glm::dvec3 eye_m = camera.eye_world * unit_m;
        EXPECT_NEAR(eye_m.y, 1.6, 0.03) << unit_m;
        const settings::Camera metres = firstViewOf(furnishedRoom(1), {}).cameraFor(kSize);
        EXPECT_LT(glm::distance(eye_m, metres.eye_world), 0.05) << unit_m;
    }
}

TEST(FirstView, UnderASky_IsOfTheHouseFromOutside) {
    Scene scene = makeRoom({0, 0, 0}, 100);
    const Scene house = makeBox({0, 5, 0}, 5);
    scene.meshes.push_back(house.meshes[0]);
    scene.instances.push_back(house.instances[0]);
    scene.instances[1].mesh = 1;
    EXPECT_FALSE(isRoom(scene));
    const settings::Sphere sphere = enclosingSphere(scene);
    EXPECT_EQ(sphere.center, glm::dvec3(0, 5, 0));
    EXPECT_NEAR(sphere.radius_m, 5 * std::sqrt(3.0), 1e-3);
    scene.instances[1].world_from_object = scene.instances[1].world_from_object * 8.0;
    scene.instances[1].world_from_object[3] = glm::dvec4(45, -55, 0, 1);
    EXPECT_TRUE(isRoom(scene)) << "things in a room are more of it";
}

struct Seen {
    const char* name;
    glm::dvec3 from;
    glm::dvec3 at;
    bool sees;
};
class SeesAnything : public testing::TestWithParam<Seen> {};

TEST_P(SeesAnything, OfABox) {
    const Scene scene = makeBox({0, 0, 0}, 1);
    EXPECT_EQ(seesAnything(scene, looking("", GetParam().from, GetParam().at).camera),
              GetParam().sees);
}

INSTANTIATE_TEST_SUITE_P(All,
                         SeesAnything,
                         testing::Values(Seen{"before", {0, 0, 5}, {0, 0, 0}, true},
                                         Seen{"behind", {0, 0, 5}, {0, 0, 9}, false},
                                         Seen{"above", {0, 0, 5}, {0, 9, 0}, false},
                                         Seen{"below", {0, 0, 5}, {0, -9, 0}, false},
                                         Seen{"within", {0, 0, 0}, {0, 0, 1}, false}),
                         [](const auto& seen) { return std::string(seen.param.name); });

} // namespace
} // namespace froxel::scene

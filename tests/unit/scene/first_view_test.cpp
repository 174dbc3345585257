#include "scene/first_view.h"
#include "unit/scene/boxes.h"

#include <gtest/gtest.h>

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
              "camera 'away' sees nothing of the scene; another view is the first");
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
                         [](const auto& info) { return std::string(info.param.name); });

} // namespace
} // namespace froxel::scene

#include "app/scene_camera.h"
#include "scene/enclosing_sphere.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>
#include <memory>
#include <utility>

namespace froxel::app {
namespace {

constexpr settings::Size kSize{100, 200};

// Seen from +X and from the usual side.
scene::Primitive triangle() {
    scene::Primitive primitive;
    primitive.positions = {{0, -1, 1}, {0, -1, -1}, {0, 1, 0}};
    primitive.bounds = {{0, -1, -1}, {0, 1, 1}};
    primitive.indices = {0, 1, 2};
    return primitive;
}

scene::Scene twoCameras() {
    scene::Scene scene;
    scene.materials.resize(1);
    scene.meshes = {{"", {triangle()}}};
    scene.instances = {{}};
    scene.cameras = {{"nave", settings::lookAt({1, 0, 0}, {0, 0, 0}, {0, 1, 0})},
                     {"apse", settings::lookAt({2, 0, 0}, {0, 0, 0}, {0, 1, 0})}};
    scene.bounds_world.add(glm::dvec3(-1));
    scene.bounds_world.add(glm::dvec3(1));
    return scene;
}

TEST(FindCamera, Default_IsTheFirst) {
    const auto scene = twoCameras();
    EXPECT_EQ(findCamera(DefaultCamera{}, scene, kSize).value(), scene.cameras[0].camera);
}

TEST(FindCamera, DefaultWithoutCameras_IsTheOverview) {
    auto scene = twoCameras();
    scene.cameras.clear();
    EXPECT_EQ(findCamera(DefaultCamera{}, scene, kSize).value(),
              settings::overview(scene::enclosingSphere(scene), 0.5));
}

// The triangle, at x = 0, goes to x = 10 and back in the clip's 2 s.
TEST(FindCamera, DefaultOfAnAnimation_ShowsItOverItsLength) {
    auto scene = twoCameras();
    scene.cameras.clear();
    scene::Motion motion;
    motion.nodes.resize(1);
    motion.instances = {{0, 0, glm::dmat4(1), scene::kNone}};
    motion.clips = {{"go",
                     2,
                     {{scene::Interpolation::kLinear, 3, {0, 1, 2}, {0, 0, 0, 10, 0, 0, 0, 0, 0}}},
                     {{0, 0, scene::ChannelPath::kTranslation}}}};
    scene.motion = std::make_shared<const scene::Motion>(std::move(motion));
    const settings::Sphere sphere = firstViewOf(scene).sphere_world;
    for (const double x : {0.0, 10 * 6.0 / 7, 5.0}) {
        EXPECT_LE(glm::distance(sphere.center, glm::dvec3(x, 0, 0)), sphere.radius_m) << x;
    }
    EXPECT_LT(sphere.radius_m, 7);
    scene.motion = nullptr;
    EXPECT_LT(firstViewOf(scene).sphere_world.radius_m, 2) << "where it rests";
}

TEST(FindCamera, Name_IsThatOne) {
    const auto scene = twoCameras();
    EXPECT_EQ(findCamera(std::string("apse"), scene, kSize).value(), scene.cameras[1].camera);
}

TEST(FindCamera, UnknownName_RefusedWithTheNames) {
    const auto camera = findCamera(std::string("crypt"), twoCameras(), kSize);
    ASSERT_TRUE(camera.has_error());
    EXPECT_EQ(camera.error().code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(camera.error().message,
              "--camera: 'crypt' is not a camera of this scene; it has nave, apse");
}

TEST(FindCamera, Numbers_AreTaken) {
    const auto camera = settings::lookAt({3, 4, 5}, {0, 0, 0}, {0, 1, 0});
    EXPECT_EQ(findCamera(camera, twoCameras(), kSize).value(), camera);
}

} // namespace
} // namespace froxel::app

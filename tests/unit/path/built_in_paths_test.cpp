#include "path/built_in_paths.h"

#include <gtest/gtest.h>

namespace froxel::path {
namespace {

settings::Camera firstCamera() {
    return settings::lookAt({3, 2, 4}, {0, 1, 0}, {0, 1, 0});
}

TEST(BuiltInPath, Turntable_KeepsHeightDistanceAndTarget) {
    const auto keys = builtInPath(BuiltIn::kTurntable, {}, firstCamera(), 10);
    ASSERT_TRUE(check(keys));
    const CameraPath path(keys);
    EXPECT_LT(glm::distance(path.at(0).eye_world, firstCamera().eye_world), 1e-9);
    for (double t = 0; t < 10; t += 0.1) {
        const auto camera = path.at(t);
        EXPECT_NEAR(camera.eye_world.y, 2, 1e-9);
        EXPECT_NEAR(glm::distance(camera.eye_world, glm::dvec3(0, 2, 0)), 5, 1e-3);
        EXPECT_LT(glm::distance(camera.target_world(), glm::dvec3(0, 1, 0)), 1e-2);
    }
    const glm::dvec3 half = path.at(5).eye_world;
    EXPECT_LT(glm::distance(half, glm::dvec3(-3, 2, -4)), 1e-3);
}

TEST(BuiltInPath, TurntableFromAbove_IsAPath) {
    const auto above = settings::lookAt({0, 9, 0}, {0, 0, 0}, {0, 0, -1});
    const auto keys = builtInPath(BuiltIn::kTurntable, {}, above, 10);
    ASSERT_TRUE(check(keys));
    EXPECT_NEAR(CameraPath(keys).at(3).eye_world.y, 9, 1e-9);
}

TEST(BuiltInPath, Flythrough_VisitsTheScenesCameras) {
    scene::Scene scene;
    scene.cameras = {{"a", firstCamera()},
                     {"b", settings::lookAt({9, 2, 4}, {0, 1, 0}, {0, 1, 0})},
                     {"c", settings::lookAt({9, 2, -4}, {0, 1, 0}, {0, 1, 0})}};
    const auto keys = builtInPath(BuiltIn::kFlythrough, scene, firstCamera(), 6);
    ASSERT_TRUE(check(keys));
    ASSERT_EQ(keys.keys.size(), 3U);
    EXPECT_LT(glm::distance(CameraPath(keys).at(3).eye_world, glm::dvec3(9, 2, 4)), 1e-9);
}

TEST(BuiltInPath, FlythroughWithoutCameras_CrossesTheScene) {
    scene::Scene scene;
    scene.bounds_world = {{-1, -1, -10}, {1, 1, 10}};
    const auto first = settings::lookAt({0, 0, 8}, {0, 0, 0}, {0, 1, 0});
    const auto keys = builtInPath(BuiltIn::kFlythrough, scene, first, 6);
    ASSERT_TRUE(check(keys));
    EXPECT_NEAR(CameraPath(keys).at(6).eye_world.z, 8 - 0.9 * 18, 1e-9);
}

} // namespace
} // namespace froxel::path

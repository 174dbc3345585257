// A scene at a time.
#include "motion/player.h"
#include "motion/posed_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace froxel::motion {
namespace {

using scene::ChannelPath;
using scene::Motion;
using scene::Scene;

scene::Primitive triangle() {
    scene::Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    primitive.normals.assign(3, {0, 0, 1});
    primitive.indices = {0, 1, 2};
    for (const glm::vec3& p : primitive.positions) {
        primitive.bounds.add(p);
    }
    return primitive;
}

// A still instance, one on node 0, and one that follows node 1 by a skin but hangs on node 2. Clip
// 0 moves nodes 0 and 1 along x by 10 in 1 s.
Scene threeInstances() {
    Scene scene;
    scene.materials.resize(1);
    scene.meshes = {{"rigid", {triangle()}}, {"skinned", {triangle()}}};
    scene.instances = {{0, glm::dmat4(1), ""}, {0, glm::dmat4(1), ""}, {1, glm::dmat4(1), ""}};
    Motion motion;
    motion.nodes.resize(3);
    motion.nodes[2].rest.translation = {0, 0, 99};
    motion.skins = {{"", {1}, {glm::mat4(1)}}};
    motion.deformed = {{1, 2, 0, {{{0, 1, 2, 3}, {{0, 1}, {0, 1}, {0, 1}}, {}, {}, false}}}};
    motion.instances = {{1, 0, glm::dmat4(1), scene::kNone}, {2, 2, glm::dmat4(1), 0}};
    motion.clips = {{"go",
                     1,
                     {{scene::Interpolation::kLinear, 3, {0, 1}, {0, 0, 0, 10, 0, 0}}},
                     {{0, 0, ChannelPath::kTranslation}, {0, 1, ChannelPath::kTranslation}}}};
    scene.motion = std::make_shared<const Motion>(std::move(motion));
    return scene;
}

TEST(Player, MovedInstances_GoWithTheirNodes) {
    const Scene scene = threeInstances();
    const Player player(scene);
    Moment moment;
    player.at(usualClips(player.motion()), 0.5, moment);
    ASSERT_EQ(moment.instances.size(), 3U);
    EXPECT_EQ(moment.instances[0], glm::dmat4(1));
    EXPECT_EQ(glm::dvec3(moment.instances[1][3]), glm::dvec3(5, 0, 0));
}

TEST(Player, SkinnedInstance_IgnoresItsOwnNode) {
    const Scene scene = threeInstances();
    const Player player(scene);
    Moment moment;
    player.at(usualClips(player.motion()), 0.5, moment);
    EXPECT_EQ(glm::dvec3(moment.instances[2][3]), glm::dvec3(5, 0, 0));
    EXPECT_EQ(glm::dmat3(moment.instances[2]), glm::dmat3(1));
    PosedVertices vertices;
    player.deformAt(moment, 0, 0, vertices);
    EXPECT_EQ(vertices.positions, triangle().positions); // one rigid joint: an instance
}

TEST(Player, Bounds_HoldWhatRestsAndWhatMoves) {
    const Scene scene = threeInstances();
    const Player player(scene);
    Moment moment;
    player.at(usualClips(player.motion()), 0.5, moment);
    EXPECT_LT(glm::length(moment.bounds_world.min - glm::dvec3(0)), 1e-4);
    EXPECT_LT(glm::length(moment.bounds_world.max - glm::dvec3(6, 1, 0)), 1e-4);
    const BoundsD3 whole = boundsOverClips(scene);
    EXPECT_NEAR(whole.max.x, 11, 1e-4);
    EXPECT_NEAR(whole.min.x, 0, 1e-4);
}

TEST(Player, UsedMoment_IsAsAFreshOne) {
    const Scene scene = threeInstances();
    const Player player(scene);
    Moment fresh;
    Moment used;
    const auto clips = usualClips(player.motion());
    player.at(clips, 0.7, fresh);
    for (const double time : {0.1, -3.0, 200.0, 0.7}) {
        player.at(clips, time, used);
    }
    EXPECT_EQ(used.instances, fresh.instances);
    EXPECT_EQ(used.bounds_world, fresh.bounds_world);
}

TEST(Player, InstanceOutOfRange_IsAPoint) {
    Scene scene = threeInstances();
    Motion motion = *scene.motion;
    motion.clips[0].tracks[0].values = {3e38F, 0, 0, 3e38F, 0, 0};
    scene.motion = std::make_shared<const Motion>(std::move(motion));
    const Player player(scene);
    Moment moment;
    player.at(usualClips(player.motion()), 0.5, moment);
    EXPECT_EQ(glm::dmat3(moment.instances[1]), glm::dmat3(0));
    EXPECT_EQ(glm::dvec3(moment.instances[1][3]), glm::dvec3(0));
}

TEST(PosedScene, AtATime_RestsAsItStood) {
    Scene scene = threeInstances();
    scene.lights.resize(1);
    scene.cameras.resize(1);
    Motion motion = *scene.motion;
    motion.lights = {{0, 0}};
    motion.cameras = {{0, 1}};
    scene.motion = std::make_shared<const Motion>(std::move(motion));
    const Scene posed = posedScene(scene, usualClips(*scene.motion), 0.5);
    EXPECT_EQ(posed.motion, nullptr);
    EXPECT_EQ(glm::dvec3(posed.instances[1].world_from_object[3]), glm::dvec3(5, 0, 0));
    EXPECT_EQ(posed.instances[0].world_from_object, scene.instances[0].world_from_object);
    EXPECT_EQ(posed.lights[0].position_world, glm::dvec3(5, 0, 0));
    EXPECT_EQ(posed.lights[0].direction_world, glm::dvec3(0, 0, -1));
    EXPECT_EQ(posed.cameras[0].camera.eye_world, glm::dvec3(5, 0, 0));
    EXPECT_GE(posed.bounds_world.max.x, 6);
}

TEST(PosedScene, PlacedCameras_AreThoseOfThePosedScene) {
    Scene scene = threeInstances();
    scene.cameras.resize(2);
    Motion motion = *scene.motion;
    motion.cameras = {{1, 0}};
    scene.motion = std::make_shared<const Motion>(std::move(motion));
    placeCameras(scene, usualClips(*scene.motion), 0.25);
    EXPECT_EQ(scene.cameras[1].camera.eye_world, glm::dvec3(2.5, 0, 0));
    EXPECT_EQ(scene.cameras[0].camera.eye_world, settings::Camera().eye_world);
}

TEST(MovedLights, OfFlatOrFarNodes_AreLeftOut) {
    Motion motion;
    motion.nodes.resize(3);
    motion.nodes[1].rest.scale = {1, 1, 0};
    motion.nodes[2].rest.translation = {1e30F, 0, 0};
    motion.lights = {{0, 0}, {1, 1}, {2, 2}};
    Pose then;
    pose(motion, {}, 0, then);
    std::vector<uint32_t> moved;
    eachMovedLight(
        motion, then,
        [&](uint32_t light, const glm::dvec3& /*position*/, const glm::dvec3& direction) {
            moved.push_back(light);
            EXPECT_EQ(direction, glm::dvec3(0, 0, -1));
        });
    EXPECT_EQ(moved, std::vector<uint32_t>{0});
}

TEST(PosedScene, MirroredSkin_IsAMirroredInstance) {
    Scene scene = threeInstances();
    Motion motion = *scene.motion;
    motion.nodes[1].rest.scale = {-1, 1, 1};
    scene.motion = std::make_shared<const Motion>(std::move(motion));
    const Scene posed = posedScene(scene, {}, 0);
    const glm::dmat4& world = posed.instances[2].world_from_object;
    EXPECT_LT(glm::determinant(glm::dmat3(world)), 0);
    const glm::vec3& tip = posed.meshes[1].primitives[0].positions[1];
    EXPECT_EQ(glm::dvec3(world * glm::dvec4(tip, 1)), glm::dvec3(-1, 0, 0));
    EXPECT_LT(glm::length(posed.bounds_world.min - glm::dvec3(-1, 0, 0)), 1e-4);
}

TEST(PosedScene, WithoutMotion_IsItself) {
    Scene scene = threeInstances();
    scene.motion = nullptr;
    EXPECT_EQ(posedScene(scene, {}, 3).instances.size(), 3U);
}

} // namespace
} // namespace froxel::motion

// Clips blended and carried down the nodes.
#include "motion/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

namespace froxel::motion {
namespace {

using scene::Channel;
using scene::ChannelPath;
using scene::Clip;
using scene::Interpolation;
using scene::Motion;
using scene::Track;

Track line(uint32_t width, std::vector<float> from, const std::vector<float>& to) {
    Track track{Interpolation::kLinear, width, {0, 2}, std::move(from)};
    track.values.insert(track.values.end(), to.begin(), to.end());
    return track;
}

// A root, and a child that is moved 1 along x; clip 0 turns the root about z by 90 degrees in 2 s,
// clip 1 lifts the child.
Motion twoNodes() {
    const auto half_root = static_cast<float>(std::sqrt(0.5));
    Motion motion;
    motion.nodes.resize(2);
    motion.nodes[1].parent = 0;
    motion.nodes[1].rest.translation = {1, 0, 0};
    motion.clips.resize(2);
    motion.clips[0] = {"turn",
                       2,
                       {line(4, {0, 0, 0, 1}, {0, 0, half_root, half_root})},
                       {{0, 0, ChannelPath::kRotation}}};
    motion.clips[1] = {
        "lift", 2, {line(3, {1, 0, 0}, {1, 0, 8})}, {{0, 1, ChannelPath::kTranslation}}};
    return motion;
}

glm::dvec3 placeOf(const Motion& motion, std::span<const PlayedClip> clips, double time_s) {
    Pose out;
    pose(motion, clips, time_s, out);
    return glm::dvec3(out.world_from_node[1][3]);
}

void expectNear(const glm::dvec3& actual, const glm::dvec3& expected, double error = 1e-7) {
    EXPECT_LT(glm::length(actual - expected), error)
        << actual.x << " " << actual.y << " " << actual.z;
}

TEST(Pose, WithoutClips_IsTheRestPose) {
    EXPECT_EQ(placeOf(twoNodes(), {}, 5), glm::dvec3(1, 0, 0));
}

TEST(Pose, Parent_CarriesItsChild) {
    const PlayedClip turn{.clip = 0, .clock = {.repeat = Repeat::kOnce}, .fade = {}};
    expectNear(placeOf(twoNodes(), std::span(&turn, 1), 2), {0, 1, 0});
    expectNear(placeOf(twoNodes(), std::span(&turn, 1), 1), {std::sqrt(0.5), std::sqrt(0.5), 0});
}

TEST(Pose, ClipsOfOtherParts_AddUp) {
    const PlayedClip both[] = {{.clip = 0, .clock = {.repeat = Repeat::kOnce}, .fade = {}},
                               {.clip = 1, .clock = {.repeat = Repeat::kOnce}, .fade = {}}};
    expectNear(placeOf(twoNodes(), both, 2), {0, 1, 8});
}

TEST(Pose, Usual_IsTheFirstClipForEver) {
    const Motion motion = twoNodes();
    const auto usual = usualClips(motion);
    ASSERT_EQ(usual.size(), 1U);
    EXPECT_EQ(placeOf(motion, usual, 1), placeOf(motion, usual, 7));
    EXPECT_TRUE(usualClips(Motion()).empty());
}

TEST(Pose, Usual_IsTheOneThatTheSceneNames) {
    Motion motion = twoNodes();
    motion.played = 1;
    EXPECT_EQ(usualClips(motion).at(0).clip, 1U);
    motion.played = scene::kNone;
    EXPECT_TRUE(usualClips(motion).empty());
}

TEST(Pose, CrossFade_IsHalfWayInTheMiddle) {
    Motion motion = twoNodes();
    motion.clips.push_back(
        {"up", 2, {line(3, {1, 4, 0}, {1, 4, 0})}, {{0, 1, ChannelPath::kTranslation}}});
    const PlayedClip fading[] = {{.clip = 1, .clock = {.speed = 0}, .fade = {}},
                                 {.clip = 2,
                                  .clock = {.speed = 0},
                                  .fade = {.start_s = 1, .duration_s = 2},
                                  .covers = true}};
    expectNear(placeOf(motion, fading, 0), {1, 0, 0}, 1e-15);
    expectNear(placeOf(motion, fading, 2), {1, 2, 0}, 1e-15);
    expectNear(placeOf(motion, fading, 3), {1, 4, 0}, 1e-15);
}

// Each takes its share of what all before it made: (1 - b)(1 - c), b (1 - c), c.
TEST(Pose, CrossFadeDuringAnother_GoesOnFromWhatIsSeen) {
    Motion motion = twoNodes();
    for (const float height : {4.0F, 10.0F}) {
        motion.clips.push_back({"at",
                                2,
                                {line(3, {1, height, 0}, {1, height, 0})},
                                {{0, 1, ChannelPath::kTranslation}}});
    }
    const PlayedClip fading[] = {
        {.clip = 1, .clock = {.speed = 0}, .fade = {}, .covers = true},
        {.clip = 2, .clock = {.speed = 0}, .fade = {.start_s = 0, .duration_s = 4}, .covers = true},
        {.clip = 3,
         .clock = {.speed = 0},
         .fade = {.start_s = 2, .duration_s = 4},
         .covers = true}};
    const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
    expectNear(placeOf(motion, fading, 2), {1, 2, 0}, 1e-14); // the third has only begun
    const double b = smooth(0.75);
    const double c = smooth(0.25);
    expectNear(placeOf(motion, fading, 3), {1, 4 * b * (1 - c) + 10 * c, 0}, 1e-14);
    expectNear(placeOf(motion, fading, 6), {1, 10, 0}, 1e-14);
}

TEST(Pose, CrossFadeToNothing_GoesToTheRestPose) {
    const PlayedClip fading[] = {
        {.clip = 1, .clock = {.phase_s = 1, .speed = 0}, .fade = {}, .covers = true},
        {.clip = scene::kNone,
         .clock = {},
         .fade = {.start_s = 0, .duration_s = 2},
         .covers = true}};
    expectNear(placeOf(twoNodes(), fading, 0), {1, 0, 4}, 1e-15);
    expectNear(placeOf(twoNodes(), fading, 1), {1, 0, 2}, 1e-15);
    EXPECT_EQ(placeOf(twoNodes(), fading, 2), glm::dvec3(1, 0, 0));
}

TEST(Pose, FadingInAlone_ComesFromTheRestPose) {
    const PlayedClip lift{
        .clip = 1, .clock = {.phase_s = 1, .speed = 0}, .fade = {.start_s = 0, .duration_s = 2}};
    expectNear(placeOf(twoNodes(), std::span(&lift, 1), 1), {1, 0, 2}, 1e-15);
}

TEST(Pose, SameClipTwice_IsItself) {
    const PlayedClip twice[] = {{.clip = 1, .clock = {.phase_s = 1, .speed = 0}, .fade = {}},
                                {.clip = 1, .clock = {.phase_s = 1, .speed = 0}, .fade = {}}};
    expectNear(placeOf(twoNodes(), twice, 0), {1, 0, 4}, 1e-15);
}

TEST(Pose, BlendedRotations_TakeTheShorterWay) {
    Motion motion = twoNodes();
    const auto half_root = static_cast<float>(std::sqrt(0.5));
    // The same turn as at the end of clip 0, by the opposite quaternion.
    motion.clips.push_back(
        {"same",
         2,
         {line(4, {0, 0, -half_root, -half_root}, {0, 0, -half_root, -half_root})},
         {{0, 0, ChannelPath::kRotation}}});
    const PlayedClip both[] = {
        {.clip = 0, .clock = {.speed = 1, .repeat = Repeat::kOnce}, .fade = {}},
        {.clip = 2, .clock = {}, .fade = {.start_s = 0, .duration_s = 4}}};
    expectNear(placeOf(motion, both, 2), {0, 1, 0});
}

TEST(Pose, MatrixOfANode_IsKept) {
    Motion motion = twoNodes();
    motion.nodes[0].matrix = glm::dmat4(2);
    EXPECT_EQ(placeOf(motion, {}, 0), glm::dvec3(2, 0, 0));
}

TEST(Pose, Weights_AreBlendedWithTheRest) {
    Motion motion;
    motion.nodes.resize(1);
    motion.nodes[0].weight_count = 2;
    motion.rest_weights = {0.25F, 1};
    motion.clips = {{"w", 2, {line(2, {0, 0}, {1, -2})}, {{0, 0, ChannelPath::kWeights}}}};
    const PlayedClip full{.clip = 0, .clock = {.phase_s = 1, .speed = 0}, .fade = {}};
    Pose out;
    pose(motion, std::span(&full, 1), 0, out);
    EXPECT_EQ(out.weights, (std::vector<double>{0.5, -1}));
    const PlayedClip half{
        .clip = 0, .clock = {.phase_s = 1, .speed = 0}, .fade = {.start_s = -1, .duration_s = 2}};
    pose(motion, std::span(&half, 1), 0, out);
    EXPECT_EQ(out.weights, (std::vector<double>{0.375, 0}));
}

TEST(Pose, AnyHistory_GivesTheSameBytes) {
    const Motion motion = twoNodes();
    const PlayedClip both[] = {{.clip = 0, .clock = {}, .fade = {}},
                               {.clip = 1, .clock = {.repeat = Repeat::kPingPong}, .fade = {}}};
    Pose fresh;
    pose(motion, both, 1.2345, fresh);
    Pose used;
    std::mt19937_64 random(7);
    for (int i = 0; i < 100; ++i) {
        pose(motion, both, std::uniform_real_distribution(-50.0, 50.0)(random), used);
    }
    pose(motion, both, 1.2345, used);
    ASSERT_EQ(used.world_from_node.size(), fresh.world_from_node.size());
    EXPECT_EQ(std::memcmp(used.world_from_node.data(), fresh.world_from_node.data(),
                          fresh.world_from_node.size() * sizeof(glm::dmat4)),
              0);
}

} // namespace
} // namespace froxel::motion

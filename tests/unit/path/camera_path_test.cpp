#include "path/camera_path.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <vector>

namespace froxel::path {
namespace {

using testing::HasSubstr;

Key keyAt(double at_s, const glm::dvec3& eye, const glm::dvec3& target, double fov_deg = 45) {
    Key key{at_s, settings::lookAt(eye, target, {0, 1, 0})};
    key.camera.yfov_rad = glm::radians(fov_deg);
    return key;
}

// A walk with a corner, a near and a far step, and another time for each.
PathKeys walk() {
    return {.keys = {keyAt(0, {0, 1, 0}, {5, 1, 0}, 30), keyAt(1, {1, 1, 0}, {5, 1, 1}),
                     keyAt(4, {8, 2, 0}, {9, 1, 6}, 60), keyAt(6, {8, 1, 9}, {0, 0, 0})},
            .seconds = 7};
}

double turnBetween(const settings::Camera& a, const settings::Camera& b) {
    return std::acos(std::clamp(glm::dot(a.world_from_view[2], b.world_from_view[2]), -1.0, 1.0));
}

TEST(CameraPath, Keys_AreMetAtTheirTimes) {
    const CameraPath path(walk());
    for (const Key& key : walk().keys) {
        const auto camera = path.at(key.at_s);
        EXPECT_LT(glm::distance(camera.eye_world, key.camera.eye_world), 1e-9);
        EXPECT_LT(turnBetween(camera, key.camera), 1e-6);
        EXPECT_NEAR(camera.yfov_rad, key.camera.yfov_rad, 1e-12);
        EXPECT_NEAR(camera.focus_m, key.camera.focus_m, 1e-9);
    }
    EXPECT_EQ(path.at(-1).eye_world, path.at(0).eye_world);
    EXPECT_LT(glm::distance(path.at(7).eye_world, glm::dvec3(8, 1, 9)), 1e-9)
        << "it rests at the end";
}

// Neither the place nor the speed jumps, and nothing turns back between two keys.
TEST(CameraPath, Motion_IsSmooth) {
    constexpr double kStep = 1e-3;
    const CameraPath path(walk());
    double before = -1;
    for (double t = 0; t + kStep <= 6; t += kStep) {
        const double speed =
            glm::distance(path.at(t).eye_world, path.at(t + kStep).eye_world) / kStep;
        if (before >= 0) {
            EXPECT_NEAR(speed, before, 0.15) << t;
        }
        before = speed;
    }
    for (double t = 0; t < 1; t += 0.05) {
        EXPECT_LE(path.at(t).eye_world.x, path.at(t + 0.05).eye_world.x + 1e-12);
    }
}

TEST(CameraPath, ConstantSpeed_IsConstant) {
    auto keys = walk();
    keys.constant_speed = true;
    const CameraPath path(keys);
    std::vector<double> ways;
    for (double t = 0; t + 0.1 <= 7; t += 0.1) {
        ways.push_back(glm::distance(path.at(t).eye_world, path.at(t + 0.1).eye_world));
    }
    const auto [least, most] = std::ranges::minmax(ways);
    EXPECT_GT(least, 0.97 * most); // chords are shorter than the way round a corner
    EXPECT_LT(glm::distance(path.at(7).eye_world, glm::dvec3(8, 1, 9)), 1e-9);
}

TEST(CameraPath, Loop_GoesOnWithoutAJump) {
    auto keys = walk();
    keys.loop = true;
    for (const bool constant : {false, true}) {
        keys.constant_speed = constant;
        const CameraPath path(keys);
        EXPECT_LT(glm::distance(path.at(0).eye_world, path.at(7).eye_world), 1e-9);
        EXPECT_LT(glm::distance(path.at(2.5).eye_world, path.at(9.5).eye_world), 1e-9);
        EXPECT_LT(glm::distance(path.at(-1).eye_world, path.at(6).eye_world), 1e-9);
        const glm::dvec3 in = path.at(7).eye_world - path.at(7 - 1e-4).eye_world;
        const glm::dvec3 out = path.at(7 + 1e-4).eye_world - path.at(7).eye_world;
        EXPECT_LT(glm::distance(in, out), 2e-2 * glm::length(out)) << constant;
    }
}

// By the shortest way, in proportion to the way of the eye.
TEST(CameraPath, Directions_TurnEvenly) {
    const CameraPath path(
        {.keys = {keyAt(0, {0, 0, 0}, {1, 0, 0}), keyAt(2, {0, 0, 0}, {0, 0, 1})}, .seconds = 2});
    EXPECT_NEAR(glm::degrees(turnBetween(path.at(0), path.at(0.5))), 22.5, 1e-6);
    EXPECT_NEAR(glm::degrees(turnBetween(path.at(0), path.at(1))), 45, 1e-6);
    const auto camera = path.at(1.3);
    EXPECT_EQ(camera.eye_world, glm::dvec3(0));
    EXPECT_NEAR(glm::determinant(camera.world_from_view), 1, 1e-12);
}

// Keys that lie together, and far from the origin: no cusp, no NaN.
TEST(CameraPath, HardKeys_StayFinite) {
    const glm::dvec3 far(1e6, -1e6, 1e6);
    const CameraPath path({.keys = {keyAt(0, far, far + glm::dvec3(1, 0, 0)),
                                    keyAt(1, far, far + glm::dvec3(0, 1e-3, 1)),
                                    keyAt(2, far + glm::dvec3(1e-7, 0, 0), far),
                                    keyAt(3, far + glm::dvec3(50, 0, 0), far),
                                    keyAt(4, far + glm::dvec3(50, 0, 0), far)},
                           .seconds = 5});
    for (double t = 0; t <= 5; t += 0.01) {
        const auto camera = path.at(t);
        ASSERT_TRUE(std::isfinite(camera.eye_world.x) && std::isfinite(camera.focus_m)) << t;
        ASSERT_NEAR(glm::determinant(camera.world_from_view), 1, 1e-9) << t;
        ASSERT_LE(camera.eye_world.x, far.x + 50 + 1e-6) << t;
        ASSERT_GE(camera.eye_world.x, far.x - 1e-6) << t;
    }
}

TEST(CameraPath, OneKey_IsACameraThatRests) {
    const CameraPath path({.keys = {keyAt(0, {1, 2, 3}, {0, 0, 0})}, .seconds = 4});
    EXPECT_EQ(path.at(2), path.at(0));
    EXPECT_EQ(path.at(2).eye_world, glm::dvec3(1, 2, 3));
}

TEST(CameraPathCheck, Faults_NameTheKey) {
    const auto fault = [](PathKeys keys) {
        const auto checked = check(keys);
        return checked ? std::string("none") : checked.error().message;
    };
    EXPECT_EQ(fault(walk()), "none");
    EXPECT_THAT(fault({}), HasSubstr("keys has 0; it must have 1 to 1000"));
    auto keys = walk();
    keys.keys[2].at_s = 1;
    EXPECT_THAT(fault(keys), HasSubstr("keys[2].at_s is 1; it must be more than 1"));
    keys = walk();
    keys.seconds = 5;
    EXPECT_THAT(fault(keys), HasSubstr("seconds is 5; it must be at least 6"));
    keys.seconds = 6;
    keys.loop = true;
    EXPECT_THAT(fault(keys), HasSubstr("seconds is 6; it must be more than 6"));
    keys = walk();
    keys.constant_speed = true;
    keys.keys[1].camera.eye_world = keys.keys[0].camera.eye_world;
    EXPECT_THAT(fault(keys), HasSubstr("keys[1].eye is that of the key before it"));
}

} // namespace
} // namespace froxel::path

#include "settings/camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace froxel::settings {
namespace {

void expectNear(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance = 1e-12) {
    EXPECT_LE(glm::distance(actual, expected), tolerance)
        << actual.x << " " << actual.y << " " << actual.z;
}

void expectRotation(const glm::dmat3& matrix) {
    const glm::dmat3 product = glm::transpose(matrix) * matrix;
    for (int column = 0; column < 3; ++column) {
        expectNear(product[column], glm::dmat3(1)[column]);
    }
    EXPECT_NEAR(glm::determinant(matrix), 1, 1e-12);
}

TEST(LookAt, OrdinaryView_PointsAtTheTarget) {
    const Camera camera = lookAt({1, 2, 3}, {4, 6, 3}, {0, 1, 0});
    expectRotation(camera.world_from_view);
    expectNear(-camera.world_from_view[2], {0.6, 0.8, 0});
    EXPECT_DOUBLE_EQ(camera.focus_m, 5);
    expectNear(camera.target_world(), {4, 6, 3});
    EXPECT_GT(camera.world_from_view[1].y, 0); // up stays up
}

TEST(LookAt, UpAlongTheView_StillGivesARotation) {
    for (const glm::dvec3 direction :
         {glm::dvec3(0, -1, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
        const Camera camera = lookAt({0, 0, 0}, direction * 2.0, direction);
        expectRotation(camera.world_from_view);
        expectNear(-camera.world_from_view[2], direction);
    }
    expectRotation(lookAt({0, 0, 0}, {1, 0, 0}, {0, 0, 0}).world_from_view);
}

TEST(LookAt, EyeAtTarget_LooksAlongMinusZ) {
    const Camera camera = lookAt({7, 8, 9}, {7, 8, 9}, {0, 1, 0});
    EXPECT_EQ(camera.world_from_view, glm::dmat3(1));
    EXPECT_EQ(camera.eye_world, glm::dvec3(7, 8, 9));
}

TEST(LookAt, FarFromTheOrigin_KeepsTheDirection) {
    const glm::dvec3 origin(1e6, 1e6, 1e6);
    const Camera camera = lookAt(origin, origin + glm::dvec3(0, 0, -5), {0, 1, 0});
    expectNear(-camera.world_from_view[2], {0, 0, -1});
    EXPECT_DOUBLE_EQ(camera.focus_m, 5);
}

// A sphere is in the picture where the view axis turns by less than the half angle towards its
// outline: every point of it, whatever the picture's shape.
TEST(Overview, AnyAspect_HasEveryPointOfTheSphereInThePicture) {
    const Sphere sphere{{30, -4, 2}, 7};
    for (const double aspect : {0.1, 0.5625, 1.0, 16.0 / 9, 8.0}) {
        const Camera camera = overview(sphere, aspect);
        expectRotation(camera.world_from_view);
        double most = 0; // of half pictures
        for (int i = 0; i < 100; ++i) {
            for (int k = 0; k < 100; ++k) {
                const double up = (2 * i + 1) / 100.0 - 1;
                const double turn = 2 * glm::pi<double>() * k / 100;
                const double level = std::sqrt(1 - up * up);
                const glm::dvec3 on(level * std::cos(turn), up, level * std::sin(turn));
                const glm::dvec3 at = glm::transpose(camera.world_from_view) *
                                      (sphere.center + on * sphere.radius_m - camera.eye_world);
                ASSERT_LT(at.z, -camera.near_m);
                const double half_height = -at.z * std::tan(camera.yfov_rad / 2);
                most = std::max(
                    {most, std::abs(at.x) / (half_height * aspect), std::abs(at.y) / half_height});
            }
        }
        EXPECT_LT(most, 1) << aspect;
        EXPECT_GT(most, 0.9) << aspect; // and it fills the picture
    }
}

TEST(Overview, ScaledSphere_IsSeenFromAsFarInItsRadii) {
    const Camera whole = overview({{0, 0, 0}, 1}, 1);
    for (const double scale : {0.01, 1000.0}) {
        const Camera scaled = overview({{0, 0, 0}, scale}, 1);
        expectNear(scaled.eye_world / scale, whole.eye_world);
        EXPECT_LT(scaled.near_m, scale);
    }
}

} // namespace
} // namespace froxel::settings

#include "view/camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace froxel::view {
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

} // namespace
} // namespace froxel::view

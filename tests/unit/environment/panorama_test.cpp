#include "environment/panorama.h"
#include "unit/environment/axes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace froxel::environment {
namespace {

using std::numbers::pi;

void expectNear(const glm::dvec3& is, const glm::dvec3& wanted, double error) {
    EXPECT_LT(glm::distance(is, wanted), error) << is.x << ' ' << is.y << ' ' << is.z << " is not "
                                                << wanted.x << ' ' << wanted.y << ' ' << wanted.z;
}

} // namespace

// three.js: u = atan(z, x) / 2 pi + 1/2; rows from the top.
TEST(Panorama, Places_AreThoseOfOtherViewers) {
    expectNear(directionAt({0.5, 0.5}), {1, 0, 0}, 1e-15);
    expectNear(directionAt({0.75, 0.5}), {0, 0, 1}, 1e-15);
    expectNear(directionAt({0.25, 0.5}), {0, 0, -1}, 1e-15);
    expectNear(directionAt({0, 0.5}), {-1, 0, 0}, 1e-15);
    expectNear(directionAt({0.3, 0}), {0, 1, 0}, 1e-15);
    expectNear(directionAt({0.3, 1}), {0, -1, 0}, 1e-15);
}

TEST(Panorama, PlaceOfDirection_IsItsOwn) {
    for (const glm::dvec2 place : {glm::dvec2(0.1, 0.2), {0.9, 0.8}, {0.49, 0.01}, {0.5, 0.99}}) {
        EXPECT_LT(glm::distance(placeOf(directionAt(place)), place), 1e-12);
    }
}

TEST(Panorama, SixColouredAxes_AreFoundWhereTheyPoint) {
    const LinearImage image = panoramaOf(64, [](const glm::dvec3& direction) {
        const auto axis = static_cast<double>(nearestAxis(direction));
        return glm::dvec3(axis, 5 - axis, 1);
    });
    for (size_t i = 0; i < kAxes.size(); ++i) {
        const auto axis = static_cast<double>(i);
        expectNear(radianceFrom(image, kAxes[i]), {axis, 5 - axis, 1}, 1e-12);
    }
}

TEST(Panorama, BetweenTexels_IsLinearAndHasNoSeam) {
    LinearImage image{4, 2, std::vector<float>(24, 0)};
    image.rgb[0] = 1; // column 0
    image.rgb[9] = 3; // column 3, its neighbour over the edge
    EXPECT_NEAR(radianceFrom(image, directionAt({0.125, 0.25})).x, 1, 1e-12);
    EXPECT_NEAR(radianceFrom(image, directionAt({0.0, 0.25})).x, 2, 1e-12);
    EXPECT_NEAR(radianceFrom(image, directionAt({0.125, 0.5})).x, 0.5, 1e-12);
    EXPECT_NEAR(radianceFrom(image, directionAt({0.125, 0.01})).x, 1, 1e-12);
}

TEST(Panorama, SolidAngles_AreTheSphere) {
    for (const uint32_t width : {2U, 6U, 64U, 1000U}) {
        const LinearImage image{width, width / 2, {}};
        double sum = 0;
        for (uint32_t row = 0; row < image.height_px; ++row) {
            sum += texelSolidAngle(image, row) * width;
        }
        EXPECT_NEAR(sum, 4 * pi, 1e-13) << width;
    }
}

// 1 + y^2 over the sphere is 4/3.
TEST(Panorama, MeanRadiance_WeighsRowsBySolidAngle) {
    const LinearImage image =
        panoramaOf(256, [](const glm::dvec3& d) { return glm::dvec3(1 + d.y * d.y, 1, 1 + d.x); });
    expectNear(meanRadiance(image), {4.0 / 3, 1, 1}, 1e-4);
}

TEST(Panorama, Turned_GoesFromFrontToRight) {
    expectNear(turned({0, 0, 1}, pi / 2), {1, 0, 0}, 1e-15);
    expectNear(turned({1, 0, 0}, pi / 2), {0, 0, -1}, 1e-15);
    expectNear(turned({0.6, 0.8, 0}, 2 * pi), {0.6, 0.8, 0}, 1e-15);
}

} // namespace froxel::environment

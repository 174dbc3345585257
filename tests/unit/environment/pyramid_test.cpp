#include "environment/pyramid.h"
#include "environment/studio.h"
#include "unit/environment/axes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace froxel::environment {

TEST(Pyramid, EveryLevel_HasTheSameMean) {
    for (const uint32_t width : {2U, 100U, 128U}) {
        const Pyramid pyramid(panoramaOf(
            width, [](const glm::dvec3& d) { return glm::dvec3(std::exp(3 * d.x), 1 + d.y, 7); }));
        const glm::dvec3 mean = meanRadiance(pyramid.levels()[0]);
        for (const LinearImage& level : pyramid.levels()) {
            EXPECT_LT(glm::distance(meanRadiance(level), mean), 1e-5) << width;
        }
        EXPECT_EQ(pyramid.levels().back().width_px, 2U);
    }
}

TEST(Pyramid, Mean_GoesFromTexelToAll) {
    const Pyramid pyramid(studioPanorama(256));
    const glm::dvec3 key = glm::normalize(glm::dvec3(-0.54, 0.64, 0.54));
    const double texel_sr = texelSolidAngle(pyramid.levels()[0], 64);
    EXPECT_EQ(pyramid.mean(key, texel_sr / 4), radianceFrom(pyramid.levels()[0], key));
    EXPECT_GT(pyramid.mean(key, texel_sr).x, pyramid.mean(key, 2).x);
    EXPECT_NEAR(pyramid.mean(key, 100).x, 1, 0.6); // two texels are left
}

// By octaves of rows: a quarter of one away from a level, that level has three quarters of it.
TEST(Pyramid, Mean_BetweenTwoLevels_IsNearerToTheNearerOne) {
    const Pyramid pyramid(panoramaOf(64, [](const glm::dvec3& d) {
        return glm::dvec3(std::exp(3 * d.x), std::exp(3 * d.y), std::exp(3 * d.z));
    }));
    const LinearImage& fine = pyramid.levels()[1]; // 16 rows
    const LinearImage& coarse = pyramid.levels()[2];
    ASSERT_EQ(fine.height_px, 16U);
    ASSERT_EQ(coarse.height_px, 8U);
    for (const glm::dvec3& direction :
         {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::normalize(glm::dvec3(0.3, -0.5, 0.8))}) {
        const glm::dvec3 of_fine = radianceFrom(fine, direction);
        const glm::dvec3 of_coarse = radianceFrom(coarse, direction);
        ASSERT_GT(glm::distance(of_fine, of_coarse), 1e-3);
        for (const double share : {0.25, 0.75}) {
            const double side = std::numbers::pi / (16 * std::exp2(-share));
            const glm::dvec3 mean = pyramid.mean(direction, side * side);
            const glm::dvec3 expected = glm::mix(of_fine, of_coarse, share);
            EXPECT_LT(glm::distance(mean, expected), 1e-9) << share;
        }
    }
}

} // namespace froxel::environment

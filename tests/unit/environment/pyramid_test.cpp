#include "environment/pyramid.h"
#include "environment/studio.h"
#include "unit/environment/axes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

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

} // namespace froxel::environment

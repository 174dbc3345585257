#include "environment/studio.h"
#include "environment/studio_table.h"
#include "environment/surroundings.h"
#include "unit/environment/axes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>

namespace froxel::environment {

// What a white matt surface sends that faces along `normal`.
double whiteFacing(const glm::dvec3& normal, int directions = 200'000) {
    double sum = 0;
    eachDirection(directions, [&](const glm::dvec3& d) {
        sum += studioRadiance(d) * std::max(0.0, glm::dot(d, normal));
    });
    return 4 * sum / directions;
}

TEST(Studio, White_StaysWithinTheToneMapOnEverySide) {
    EXPECT_NEAR(whiteFacing({0, 1, 0}), 1.00, 0.01);
    EXPECT_NEAR(whiteFacing({0, 0, 1}), 0.80, 0.01);
    EXPECT_NEAR(whiteFacing({1, 0, 0}), 0.55, 0.01);
    EXPECT_NEAR(whiteFacing({0, -1, 0}), 0.40, 0.01);
    double most = 0;
    eachDirection(200, [&](const glm::dvec3& d) { most = std::max(most, whiteFacing(d, 20'000)); });
    EXPECT_LT(most, 1.25);
}

TEST(Studio, IsNeutral) {
    const LinearImage studio = studioPanorama(64);
    for (size_t i = 0; i < studio.rgb.size(); i += 3) {
        ASSERT_EQ(studio.rgb[i], studio.rgb[i + 1]);
        ASSERT_EQ(studio.rgb[i], studio.rgb[i + 2]);
    }
}

// The key stands in front, to the left and above as a camera in front (at +Z) sees the scene: at
// -X.
TEST(Studio, Key_IsFrontLeft) {
    const double key = studioRadiance(directionAt(placeOf({-0.54, 0.64, 0.54})));
    EXPECT_GT(key, 2 * studioRadiance({0, 0, 1}));
    EXPECT_GT(key, 2 * studioRadiance({0, -1, 0}));
    EXPECT_GT(studioRadiance({0, 1, 0}), studioRadiance({0, -1, 0}));
    EXPECT_GT(studioRadiance({0, -1, 0}), 0);
}

TEST(Studio, Table_IsWhatFilteringItGives) {
    const Surroundings made = surroundingsOf(studioPanorama(kStudioWidth_px));
    const Surroundings& kept = studioSurroundings();
    EXPECT_EQ(kept.matt.terms, made.matt.terms);
    ASSERT_EQ(kept.glossy.levels.size(), made.glossy.levels.size());
    for (size_t i = 0; i < made.glossy.levels.size(); ++i) {
        EXPECT_EQ(kept.glossy.levels[i].size_px, made.glossy.levels[i].size_px);
        EXPECT_EQ(kept.glossy.levels[i].roughness, made.glossy.levels[i].roughness);
        EXPECT_EQ(kept.glossy.levels[i].rgb, made.glossy.levels[i].rgb) << i;
    }
}

} // namespace froxel::environment

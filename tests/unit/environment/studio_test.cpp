#include "environment/studio.h"
#include "unit/environment/axes.h"

#include <gtest/gtest.h>

namespace froxel::environment {

TEST(Studio, MeanRadiance_IsOne) {
    constexpr int kDirections = 1'000'000;
    double sum = 0;
    eachDirection(kDirections, [&](const glm::dvec3& d) { sum += studioRadiance(d); });
    EXPECT_NEAR(sum / kDirections, 1, 1e-4);
    EXPECT_NEAR(meanRadiance(studioPanorama(512)).x, 1, 1e-3);
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

} // namespace froxel::environment

#include "environment/albedo.h"
#include "environment/glossy.h"
#include "environment/prefiltered.h"
#include "environment/studio.h"
#include "unit/environment/axes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace froxel::environment {

TEST(Cube, Faces_AreVulkans) {
    for (uint32_t face = 0; face < 6; ++face) {
        EXPECT_EQ(cubeDirection(face, 0.5, 0.5), kAxes[face]);
    }
    // Of +Z: s goes with +X and t with -Y; of +Y: s with +X, t with +Z.
    EXPECT_GT(cubeDirection(4, 0.9, 0.5).x, 0);
    EXPECT_LT(cubeDirection(4, 0.5, 0.9).y, 0);
    EXPECT_GT(cubeDirection(2, 0.9, 0.5).x, 0);
    EXPECT_GT(cubeDirection(2, 0.5, 0.9).z, 0);
    EXPECT_LT(cubeDirection(0, 0.9, 0.5).z, 0);
    EXPECT_LT(cubeDirection(5, 0.9, 0.5).x, 0);
}

TEST(Cube, PlaceOfDirection_IsItsOwn) {
    for (uint32_t face = 0; face < 6; ++face) {
        for (const double x : {0.01, 0.3, 0.99}) {
            const CubePlace place = cubePlace(cubeDirection(face, x, 0.2));
            EXPECT_EQ(place.face, face);
            EXPECT_NEAR(place.x, x, 1e-12);
            EXPECT_NEAR(place.y, 0.2, 1e-12);
        }
    }
}

TEST(Cube, AcrossEdges_IsContinuous) {
    CubeLevel level{8, 0, {}};
    for (uint32_t face = 0; face < 6; ++face) {
        for (int i = 0; i < 64; ++i) {
            const glm::dvec3 d = cubeDirection(face, (i % 8 + 0.5) / 8, (i / 8 + 0.5) / 8);
            level.rgb.insert(level.rgb.end(), {static_cast<float>(d.x), static_cast<float>(d.y),
                                               static_cast<float>(d.z)});
        }
    }
    for (const double along : {-0.7, 0.1, 0.5}) {
        const glm::dvec3 one = level.at(glm::normalize(glm::dvec3(1, along, 1 - 1e-9)));
        const glm::dvec3 other = level.at(glm::normalize(glm::dvec3(1 - 1e-9, along, 1)));
        EXPECT_LT(glm::distance(one, other), 1e-6) << along;
    }
}

TEST(Prefiltered, ConstantEnvironment_IsItself) {
    const Pyramid pyramid(
        panoramaOf(32, [](const glm::dvec3&) { return glm::dvec3(0.25, 1, 64); }));
    const Prefiltered map = prefilter(pyramid, {.finest_px = 16, .samples = 32});
    for (const CubeLevel& level : map.levels) {
        for (size_t i = 0; i < level.rgb.size(); i += 3) {
            ASSERT_NEAR(level.rgb[i], 0.25F, 1e-6F);
            ASSERT_NEAR(level.rgb[i + 2], 64.0F, 1e-4F);
        }
    }
}

// What reflects all of it is not seen in it.
TEST(Prefiltered, WhiteFurnace) {
    const Prefiltered map =
        prefilter(Pyramid(panoramaOf(32, [](const glm::dvec3&) { return glm::dvec3(1); })),
                  {.finest_px = 16, .samples = 32});
    for (double roughness = 0; roughness <= 1; roughness += 0.0625) {
        for (const double u : {0.0, 0.01, 0.2, 1.0}) {
            const double share = reflectedShare(1, albedoFromTable(u, roughness));
            EXPECT_NEAR(map.at(kAxes[4], roughness).x * share, 1, 1e-6) << roughness << ' ' << u;
        }
    }
}

TEST(Prefiltered, Levels_AreOfTheirRoughness) {
    const Prefiltered map = prefilter(Pyramid(studioPanorama(8)), {.finest_px = 32, .samples = 8});
    ASSERT_EQ(map.levels.size(), 4U);
    for (size_t i = 0; i < map.levels.size(); ++i) {
        EXPECT_EQ(map.levels[i].size_px, 32U >> i);
        EXPECT_NEAR(levelOf(map.levels[i].roughness, 4), static_cast<double>(i), 1e-12);
    }
    EXPECT_NEAR(map.levels[1].roughness, 0.5, 1e-12);
    EXPECT_NEAR(map.levels[2].roughness, std::sqrt(0.5), 1e-12);
    EXPECT_EQ(map.levels[3].roughness, 1);
    EXPECT_EQ(levelOf(0, 4), 0);
}

// Against a thousand times as many samples of the texels themselves.
TEST(Prefiltered, Studio_IsNearTheReference) {
    const LinearImage studio = studioPanorama(256);
    const Prefiltered map = prefilter(Pyramid(studio), {.finest_px = 64, .samples = 128});
    for (size_t i = 1; i < map.levels.size(); ++i) {
        double squares = 0;
        int count = 0;
        eachDirection(40, [&](const glm::dvec3& normal) {
            const double wanted = meanOfLobe(studio, normal, map.levels[i].roughness, 8192).x;
            squares += std::pow(map.levels[i].at(normal).x - wanted, 2);
            ++count;
        });
        const double rms = std::sqrt(squares / count);
        RecordProperty("rms_" + std::to_string(i), std::to_string(rms));
        EXPECT_LT(rms, 0.05) << map.levels[i].roughness; // of a mean of 1
    }
}

TEST(Prefiltered, Mirror_KeepsOrientation) {
    const Prefiltered map =
        prefilter(Pyramid(panoramaOf(64,
                                     [](const glm::dvec3& d) {
                                         return glm::dvec3(static_cast<double>(nearestAxis(d)));
                                     })),
                  {.finest_px = 16, .samples = 16});
    for (size_t i = 0; i < kAxes.size(); ++i) {
        EXPECT_NEAR(map.at(kAxes[i], 0).x, static_cast<double>(i), 1e-6);
    }
}

} // namespace froxel::environment

#include "assign_cases.h"
#include "cluster/slice_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>

namespace froxel::cluster::testing {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

class EverySliceLaw : public ::testing::TestWithParam<settings::GridLaw> {
  protected:
    [[nodiscard]] static ClusterGrid gridOf(uint32_t slices, double near_m, double far_m) {
        return makeClusterGrid({{1, 1, slices}, GetParam()}, {64, 64}, perspective(45), near_m,
                               far_m);
    }
};

// What shaders/lib/frame.glsl does, written out once more: umulExtended keeps the upper word.
uint32_t sliceInShader(const SliceLaw& law, float distance) {
    const auto fixed = [&] {
        return static_cast<uint32_t>(std::min(distance * law.unit, 2147483520.0F));
    };
    uint32_t key = 0;
    if (law.kind == settings::GridLaw::kHyperbolic) {
        const uint32_t left = 0xffffffffU / std::max(fixed(), 1U);
        key = law.first - std::min(left, law.first);
    } else {
        key = law.kind == settings::GridLaw::kLinear ? fixed() : std::bit_cast<uint32_t>(distance);
        key = std::max(key, law.first) - law.first;
    }
    return static_cast<uint32_t>((uint64_t{key} * law.scale) >> 32U) >> law.shift;
}

TEST_P(EverySliceLaw, Planes_AscendForExtremeRanges) {
    const double ranges[][2] = {{1e-3, 10}, {0.1, 1e5},   {10, 10},     {10, 10.000001},
                                {1, 0.5},   {1e-9, 1e18}, {1e-30, 1e30}};
    for (const auto& range : ranges) {
        for (const uint32_t slices : {1U, 2U, 24U, 256U}) {
            const ClusterGrid grid = gridOf(slices, range[0], range[1]);
            ASSERT_EQ(grid.plane_depths_m.size(), slices + 1U);
            EXPECT_EQ(grid.plane_depths_m.front(), 0.0F);
            for (uint32_t k = 1; k <= slices; ++k) {
                ASSERT_LT(grid.plane_depths_m[k - 1], grid.plane_depths_m[k])
                    << "plane " << k << " of " << slices << ", " << range[0] << " to " << range[1];
                ASSERT_TRUE(std::isfinite(grid.plane_depths_m[k]));
            }
        }
    }
}

TEST_P(EverySliceLaw, LastPlane_IsNotBelowTheFarAskedFor) {
    const double slack = GetParam() == settings::GridLaw::kHyperbolic ? 0.04 : 1e-6;
    for (double far_m = 1; far_m < 1e6; far_m *= 1.37) {
        const ClusterGrid grid = gridOf(24, 0.1, far_m);
        EXPECT_GE(static_cast<double>(grid.plane_depths_m.back()), far_m);
        EXPECT_LE(static_cast<double>(grid.plane_depths_m.back()), far_m * (1 + slack));
    }
}

TEST_P(EverySliceLaw, Slices_SwitchExactlyAtThePlanes) {
    const double ranges[][2] = {{0.1, 90}, {1e-3, 1e4}, {0.9, 1}, {3e5, 7e8}, {1e-6, 2e-6}};
    for (const auto& range : ranges) {
        for (const uint32_t slices : {1U, 2U, 7U, 24U, 255U, 256U}) {
            const ClusterGrid grid = gridOf(slices, range[0], range[1]);
            for (uint32_t k = 1; k <= slices; ++k) {
                float below = grid.plane_depths_m[k];
                float above = below;
                for (int ulps = 0; ulps < 40; ++ulps) {
                    ASSERT_EQ(grid.slice_law.sliceOf(above), sliceInShader(grid.slice_law, above));
                    const auto at = grid.sliceAt(above);
                    if (k < slices && above < grid.plane_depths_m[k + 1]) {
                        ASSERT_EQ(at, k) << ulps << " ulps above plane " << k;
                    } else if (k == slices) {
                        ASSERT_EQ(at, std::nullopt) << ulps << " ulps above the last plane";
                    }
                    below = std::nextafter(below, 0.0F);
                    if (below >= grid.plane_depths_m[k - 1]) {
                        ASSERT_EQ(grid.slice_law.sliceOf(below), k - 1) << ulps << " ulps below";
                    }
                    above = std::nextafter(above, kInfinity);
                }
            }
        }
    }
}

TEST_P(EverySliceLaw, Slices_OfAnyDepth_LieBetweenTheirPlanes) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> exponent(-5, 4);
    const ClusterGrid grid = gridOf(64, 0.05, 300);
    for (int i = 0; i < 200'000; ++i) {
        const auto depth = static_cast<float>(std::pow(10.0, exponent(random)));
        ASSERT_EQ(grid.slice_law.sliceOf(depth), sliceInShader(grid.slice_law, depth)) << depth;
        const auto slice = grid.sliceAt(depth);
        if (slice) {
            ASSERT_LE(grid.plane_depths_m[*slice], depth);
            ASSERT_GT(grid.plane_depths_m[*slice + 1], depth);
        } else {
            ASSERT_GE(depth, grid.plane_depths_m.back());
        }
    }
}

TEST_P(EverySliceLaw, DepthsOutsideTheGrid_AreInNoSlice) {
    const ClusterGrid grid = gridOf(24, 0.1, 50);
    EXPECT_EQ(grid.sliceAt(0.0F), 0U);
    EXPECT_EQ(grid.sliceAt(std::numeric_limits<float>::denorm_min()), 0U);
    for (const float depth : {-1.0F, 1e6F, 3e38F, kInfinity, -kInfinity, std::nanf("")}) {
        EXPECT_EQ(grid.sliceAt(depth), std::nullopt) << depth;
    }
}

INSTANTIATE_TEST_SUITE_P(Laws,
                         EverySliceLaw,
                         ::testing::Values(settings::GridLaw::kLogarithmic,
                                           settings::GridLaw::kLinear,
                                           settings::GridLaw::kHyperbolic),
                         [](const auto& tested) {
                             return std::string(
                                 settings::kGridLawNames[static_cast<size_t>(tested.param)]);
                         });

TEST(SliceLaw, Logarithmic_MultipliesDepth) {
    const SliceLaw law = makeSliceLaw(settings::GridLaw::kLogarithmic, 3, 1, 1000);
    EXPECT_NEAR(planeDepth(law, 1), 10, 0.6);
    EXPECT_NEAR(planeDepth(law, 2), 100, 6);
    EXPECT_NEAR(planeDepth(law, 3), 1000, 1e-2);
}

TEST(SliceLaw, Linear_AddsDepth) {
    const SliceLaw law = makeSliceLaw(settings::GridLaw::kLinear, 10, 1, 101);
    for (uint32_t k = 1; k <= 10; ++k) {
        EXPECT_NEAR(planeDepth(law, k), 1 + 10.0 * k, 1e-3);
    }
}

// What NDC depth (far - far near / z) / (far - near) cuts into equal parts.
TEST(SliceLaw, Hyperbolic_DividesTheReciprocal) {
    const SliceLaw law = makeSliceLaw(settings::GridLaw::kHyperbolic, 16, 0.1, 20);
    for (uint32_t k = 1; k <= 16; ++k) {
        const double reciprocal = 10 + (0.05 - 10) * k / 16.0;
        EXPECT_NEAR(1 / static_cast<double>(planeDepth(law, k)), reciprocal, 2e-3);
    }
}

} // namespace
} // namespace froxel::cluster::testing

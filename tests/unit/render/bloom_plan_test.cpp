#include "render/steps/bloom_plan.h"

#include <gtest/gtest.h>

#include <cmath>

namespace froxel::render {
namespace {

using settings::BloomKind;

constexpr std::array kKinds = {BloomKind::kSinglePass, BloomKind::kSeparable, BloomKind::kATrous,
                               BloomKind::kMipChain};

settings::Bloom bloomOf(BloomKind kind, float radius) {
    settings::Bloom bloom;
    bloom.kind = kind;
    bloom.radius = radius;
    return bloom;
}

// Every step reads what another left, the last one adds to the picture, and none reads what it
// writes.
TEST(BloomPlan, AnyKindAndSize_IsWiredRight) {
    for (const auto kind : kKinds) {
        for (const settings::Size size :
             {settings::Size{16, 16}, {17, 4096}, {1280, 720}, {8192, 8192}}) {
            for (const float radius : {0.001F, 0.015F, 0.05F}) {
                const auto plan = planBloom(bloomOf(kind, radius), size, 1);
                ASSERT_FALSE(plan.steps.empty());
                std::vector<bool> written(plan.images.size());
                for (size_t i = 0; i < plan.steps.size(); ++i) {
                    const auto& wire = plan.steps[i].wire;
                    const bool last = i + 1 == plan.steps.size();
                    EXPECT_NE(wire.source, wire.target);
                    EXPECT_EQ(wire.target == BloomWire::kPicture, last);
                    EXPECT_TRUE(wire.source == BloomWire::kPicture || written[wire.source]);
                    if (!last) {
                        written[wire.target] = true;
                    }
                }
            }
        }
    }
}

// Within the picture mirrored once, whatever the kind.
TEST(BloomPlan, AnyReach_IsWithinTheSmallerSide) {
    for (const settings::Size size : {settings::Size{16, 4096}, {100, 90}, {8192, 8192}}) {
        for (const auto kind : kKinds) {
            for (const auto& step : planBloom(bloomOf(kind, 0.05F), size, 1).steps) {
                const auto side = std::min(step.pass.source_width_px, step.pass.source_height_px);
                const bool holes = step.shader == BloomShader::kATrous;
                EXPECT_LE(holes ? 2 * step.pass.step_x_px : 2U, side);
                EXPECT_LE(step.pass.reach, std::min(size.width_px, size.height_px));
            }
        }
    }
}

// The variance of a chain is that of its levels, the last mixed with the one before.
TEST(BloomPlan, SplinesVariance_IsTheGaussians) {
    for (const float radius : {0.002F, 0.015F, 0.033F, 0.05F}) {
        const double sigma = static_cast<double>(radius) * 720;
        double holes = 0;
        for (const auto& step :
             planBloom(bloomOf(BloomKind::kATrous, radius), {1280, 720}, 1).steps) {
            if (step.shader == BloomShader::kATrous) {
                holes += static_cast<double>(step.pass.share) * step.pass.step_x_px *
                         step.pass.step_x_px;
            }
        }
        EXPECT_NEAR(holes, sigma * sigma, 1e-5 * sigma * sigma);
        double chain = 0;
        double scale = 1.5;
        const auto plan = planBloom(bloomOf(BloomKind::kMipChain, radius), {1280, 720}, 1);
        const size_t levels = plan.images.size();
        for (size_t level = 0; level < levels; ++level) {
            const bool deepest = level + 1 == levels;
            // the first step up belongs to the deepest level
            const double share = deepest ? static_cast<double>(plan.steps[levels].pass.share) : 1;
            chain += share * scale;
            scale *= 4;
        }
        EXPECT_NEAR(chain, sigma * sigma, 1e-5 * sigma * sigma);
    }
}

TEST(BloomPlan, Threshold_IsOfExposedRadiance) {
    auto bloom = bloomOf(BloomKind::kMipChain, 0.01F);
    bloom.threshold = 2;
    bloom.knee = 0.25F;
    const auto pass = planBloom(bloom, {64, 64}, 4).steps.front().pass;
    EXPECT_EQ(pass.threshold, 0.5F);
    EXPECT_EQ(pass.knee, 0.125F);
}

TEST(BloomPlan, Kernels_OfMoreTapsThanASoftwareLoopHas_AreRefusedThere) {
    const settings::Size full{1920, 1080};
    const auto check = [&](BloomKind kind, float radius, bool cpu) {
        return checkKernels(planBloom(bloomOf(kind, radius), full, 1), cpu);
    };
    EXPECT_TRUE(check(BloomKind::kMipChain, 0.05F, true));
    EXPECT_TRUE(check(BloomKind::kSeparable, 0.05F, true));
    EXPECT_TRUE(check(BloomKind::kSinglePass, 0.005F, true));
    EXPECT_TRUE(check(BloomKind::kSinglePass, 0.05F, false));
    const auto refused = check(BloomKind::kSinglePass, 0.05F, true);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kUnsupported);
}

} // namespace
} // namespace froxel::render

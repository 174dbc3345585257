#include "bench/budget.h"
#include "bench/errors.h"
#include "bench/picture_scale.h"
#include "bench/progress.h"
#include "bench/shown_picture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace froxel::bench {
namespace {

using testing::HasSubstr;

Budget tenSeconds() {
    Budget budget;
    budget.seconds_per_row = 10;
    budget.warmup_frames = 1;
    return budget;
}

TEST(FramesThatFit, FastFrames_AreAsManyAsWanted) {
    const auto frames = framesThatFit(0.01, tenSeconds());
    EXPECT_EQ(frames.count, tenSeconds().frames_wanted);
    EXPECT_EQ(frames.remark, "");
}

TEST(FramesThatFit, SlowFrames_LeaveTheTimeForWarmUp) {
    const auto frames = framesThatFit(0.5, tenSeconds());
    EXPECT_EQ(frames.count, 16U); // of 20, less one for each round
    EXPECT_THAT(frames.remark, HasSubstr("200 were wanted"));
}

TEST(FramesThatFit, TooSlow_IsNoneAndSaysWhy) {
    const auto frames = framesThatFit(2, tenSeconds());
    EXPECT_EQ(frames.count, 0U);
    EXPECT_THAT(frames.remark, HasSubstr("a frame takes 2 s"));
}

TEST(RefusalByPrediction, NoRowBefore_IsNone) {
    EXPECT_FALSE(refusalByPrediction(std::nullopt, 1e12, tenSeconds()));
}

TEST(RefusalByPrediction, WorkTimesTheFrameBefore_IsHeldAgainstTheBudget) {
    const KnownFrame before{0.1, 1e6};
    EXPECT_FALSE(refusalByPrediction(before, 33e6, tenSeconds())); // 3 frames of 3.3 s
    EXPECT_TRUE(refusalByPrediction(before, 34e6, tenSeconds()));
    const KnownFrame slow{100, 1e6};
    EXPECT_FALSE(refusalByPrediction(slow, 1e6, tenSeconds())) << "as much work is tried";
}

TEST(Interleaved, Rows_TakeTurnsAndEveryFrameComesOnce) {
    constexpr std::array kCounts = {10U, 0U, 3U};
    std::array<uint32_t, 3> next{};
    std::vector<size_t> order;
    for (const auto& turn : interleaved(kCounts, 4)) {
        EXPECT_EQ(turn.first_frame, next.at(turn.row));
        next.at(turn.row) += turn.frame_count;
        order.push_back(turn.row);
    }
    EXPECT_THAT(next, testing::ElementsAre(10, 0, 3));
    EXPECT_THAT(order, testing::ElementsAre(0, 0, 2, 0, 2, 0, 2));
}

TEST(BudgetFor, BothKinds_AllowTheLeastFramesOfATest) {
    for (const bool cpu : {false, true}) {
        const auto budget = budgetFor(cpu, 1);
        EXPECT_GE(budget.frames_wanted, 100U);
        EXPECT_GE(budget.warmup_first, kProbeFrames);
    }
}

TEST(ViewsWithin, Limit_LeavesViewsOut) {
    const settings::Size size{100, 10};
    EXPECT_EQ(viewsWithin(3e6, size, 1000, 3), 3U);
    EXPECT_EQ(viewsWithin(2.9e6, size, 1000, 3), 2U);
    EXPECT_EQ(viewsWithin(0.9e6, size, 1000, 3), 0U);
    EXPECT_EQ(viewsWithin(1e18, size, 0, 3), 3U);
}

TEST(ErrorSizes, LargeSmallAndScaledRows) {
    Row row;
    row.settings.size = {1280, 720};
    EXPECT_EQ(errorSizes(row, {640, 360}).compared, (settings::Size{640, 360}));
    EXPECT_EQ(errorSizes(row, {640, 360}).drawn, (settings::Size{640, 360}));
    row.settings.size = {64, 36};
    EXPECT_EQ(errorSizes(row, {640, 360}).compared, (settings::Size{64, 36}));
    row.settings.size = {640, 360};
    row.scaled_to = settings::Size{1280, 720};
    EXPECT_EQ(errorSizes(row, {640, 360}).compared, (settings::Size{640, 360}));
    EXPECT_EQ(errorSizes(row, {640, 360}).drawn, (settings::Size{320, 180}));
}

TEST(R1Settings, ForwardIsNaive_DeferredLoopsOverAllOverTheSameGbuffer) {
    settings::ViewSettings settings;
    settings.gbuffer.normal = settings::NormalEncoding::kOct8;
    settings.lights.cutoff = 1;
    settings.lighting = settings::LightingStage::kCompute;
    const auto deferred = r1Settings(settings);
    EXPECT_EQ(deferred.renderer, settings::Renderer::kClusteredDeferred);
    EXPECT_EQ(deferred.light_loop, settings::LightLoop::kAllLights);
    EXPECT_EQ(deferred.gbuffer, settings.gbuffer);
    EXPECT_EQ(deferred.lights, settings.lights);
    settings.renderer = settings::Renderer::kForwardPlus;
    EXPECT_EQ(r1Settings(settings).renderer, settings::Renderer::kNaive);
    EXPECT_EQ(r1Settings(settings).lighting, settings.lighting);
}

TEST(R2Settings, WhatTradesError_IsAtItsDefaultAndWaysOfDrawingAreOne) {
    settings::ViewSettings settings;
    settings.gbuffer.normal = settings::NormalEncoding::kOct8;
    settings.lights.cutoff = 1;
    settings.lights.count = 7;
    settings.renderer = settings::Renderer::kNaive;
    settings.transparency = settings::Transparency::kWeighted;
    settings.peel_layers = 2;
    settings.fog = {0.5F, 0.25F, -3, 0.75F, {0.5F, 0.25F, 1}, 8, 32, true, true};
    settings::ViewSettings meant;
    meant.lights.count = 7;
    meant.fog = {0.5F, 0.25F, -3, 0.75F, {0.5F, 0.25F, 1}};
    EXPECT_EQ(r2Settings(settings), meant);
    settings.renderer = settings::Renderer::kToonCompute;
    EXPECT_EQ(r2Settings(settings).renderer, settings::Renderer::kToonCompute);
}

LinearImage ramp(uint32_t width_px, uint32_t height_px) {
    LinearImage image{width_px, height_px, {}};
    for (uint32_t y = 0; y < height_px; ++y) {
        for (uint32_t x = 0; x < width_px; ++x) {
            const auto fx = (static_cast<float>(x) + 0.5F) / static_cast<float>(width_px);
            const auto fy = (static_cast<float>(y) + 0.5F) / static_cast<float>(height_px);
            image.rgb.insert(image.rgb.end(), {fx, fy, 1});
        }
    }
    return image;
}

TEST(Scaled, Ramp_StaysARampAwayFromTheEdges) {
    const auto big = scaled(ramp(8, 6), {16, 18});
    const auto right = ramp(16, 18);
    for (uint32_t y = 2; y < 16; ++y) {
        for (uint32_t x = 1; x < 15; ++x) {
            for (size_t c = 0; c < 3; ++c) {
                const size_t i = (size_t{y} * 16 + x) * 3 + c;
                EXPECT_NEAR(big.rgb[i], right.rgb[i], 1e-6) << x << " " << y;
            }
        }
    }
    EXPECT_EQ(big.rgb[0], ramp(8, 6).rgb[0]) << "edges are repeated";
}

TEST(Scaled, SameSize_IsTheSame) {
    EXPECT_EQ(scaled(ramp(7, 5), {7, 5}).rgb, ramp(7, 5).rgb);
    const std::vector<std::byte> pixels(size_t{3} * 2 * 4, std::byte{77});
    EXPECT_EQ(scaled(pixels, {3, 2}, {3, 2}), pixels);
    EXPECT_EQ(scaled(pixels, {3, 2}, {7, 9}),
              std::vector<std::byte>(size_t{7} * 9 * 4, std::byte{77}));
}

std::vector<int> shown(float r, float g, float b, settings::ToneMap tone_map) {
    std::vector<int> values;
    for (const std::byte value : shownPicture({1, 1, {r, g, b}}, 1, tone_map)) {
        values.push_back(std::to_integer<int>(value));
    }
    return values;
}

TEST(ShownPicture, Clamp_IsSrgb) {
    const float inf = std::numeric_limits<float>::infinity();
    EXPECT_THAT(shown(0, 1, 2, settings::ToneMap::kClamp), testing::ElementsAre(0, 255, 255, 255));
    // 0.21586 is sRGB's 128; 0.001 lies on the straight part.
    EXPECT_THAT(shown(0.21586F, 0.001F, -1, settings::ToneMap::kClamp),
                testing::ElementsAre(128, 3, 0, 255));
    EXPECT_THAT(shown(std::nanf(""), inf, -inf, settings::ToneMap::kClamp),
                testing::ElementsAre(0, 255, 0, 255));
}

TEST(ShownPicture, PbrNeutral_KeepsBaseColoursLessTheirFresnelAndBoundsHighlights) {
    // 0.5 grey loses 0.04: 0.46 is 0.7088 in sRGB.
    EXPECT_THAT(shown(0.5F, 0.5F, 0.5F, settings::ToneMap::kPbrNeutral),
                testing::ElementsAre(181, 181, 181, 255));
    const auto bright = shown(100, 10, 10, settings::ToneMap::kPbrNeutral);
    EXPECT_GE(bright[0], 250);
    EXPECT_GT(bright[1], 200) << "highlights desaturate";
    EXPECT_LT(bright[1], 255);
}

TEST(ProgressLine, HalfWay_SaysSoAndFitsTheTerminal) {
    const auto line = progressLine(0.5, 600, "grid: 16x9x24", 200);
    EXPECT_THAT(line, HasSubstr(" 50 %, 10 min left"));
    EXPECT_THAT(line, HasSubstr("grid: 16x9x24"));
    EXPECT_EQ(progressLine(0.5, 600, "grid: 16x9x24", 20).size(), 20U);
    EXPECT_THAT(progressLine(0, 0, "", 200), HasSubstr("unknown"));
    EXPECT_THAT(progressLine(2, 10, "", 200), HasSubstr("100 %, 0 s left"));
}

} // namespace
} // namespace froxel::bench

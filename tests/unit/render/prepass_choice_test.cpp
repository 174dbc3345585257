#include "render/frame/prepass_choice.h"

#include <gtest/gtest.h>

namespace froxel::render {
namespace {

// Sponza from the middle of its nave, 1280x720.
constexpr PrepassFacts kSponza{
    .triangle_count = 114'703, .pixel_count = 1280 * 720, .overdraw = 1.63, .lights = 0};

TEST(PrepassChoice, NoOverdraw_NeverPays) {
    PrepassFacts facts = kSponza;
    facts.overdraw = 1;
    facts.lights = 1e6;
    EXPECT_FALSE(prepassPays(facts, kCpuPrepassCosts));
    EXPECT_FALSE(prepassPays(facts, kGpuPrepassCosts));
}

TEST(PrepassChoice, EmptyPixels_DoNotMakeItPay) {
    PrepassFacts facts = kSponza;
    facts.overdraw = 0.1; // a small thing before the sky
    EXPECT_FALSE(prepassPays(facts, kCpuPrepassCosts));
}

// Measured there: 68 ms for the G-buffer at once; 29 and about 55 with a prepass.
TEST(PrepassChoice, GbufferOfSponza_OnACpuDevice_DoesNotPay) {
    EXPECT_FALSE(prepassPays(kSponza, kCpuPrepassCosts));
}

TEST(PrepassChoice, ManyLightsInTheFragmentStage_Pay) {
    PrepassFacts facts = kSponza;
    facts.lights = 20;
    EXPECT_TRUE(prepassPays(facts, kCpuPrepassCosts));
    EXPECT_TRUE(prepassPays(facts, kGpuPrepassCosts));
}

TEST(PrepassChoice, TenLayersOfFewTriangles_Pay) {
    EXPECT_TRUE(prepassPays({.triangle_count = 20, .pixel_count = 1280 * 720, .overdraw = 10},
                            kCpuPrepassCosts));
}

} // namespace
} // namespace froxel::render

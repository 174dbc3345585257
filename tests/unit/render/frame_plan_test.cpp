#include "interface/constants.h"
#include "render/frame_plan.h"

#include <gtest/gtest.h>

namespace froxel::render {

namespace {

using view::LightingStage;
using view::Renderer;

FramePlan
plan(Renderer renderer, const FrameFacts& facts, LightingStage stage = LightingStage::kCompute) {
    view::ViewSettings settings;
    settings.renderer = renderer;
    settings.lighting = stage;
    return planFrame(settings, facts);
}

constexpr FrameFacts kLit{.local_lights = true, .compute_batches = true};

} // namespace

TEST(FramePlan, Naive_WithLights_IsForwardWithoutListsOrPrepass) {
    const auto p = plan(Renderer::kNaive, kLit);
    EXPECT_TRUE(p.forward);
    EXPECT_FALSE(p.depth_prepass);
    EXPECT_FALSE(p.lists);
    EXPECT_EQ(p.forward_light_flags & io::kLightLists, 0U);
    EXPECT_TRUE(p.tonemap);
}

TEST(FramePlan, ForwardPlus_WithLights_HasPrepassAndLists) {
    const auto p = plan(Renderer::kForwardPlus, kLit);
    EXPECT_TRUE(p.depth_prepass);
    EXPECT_TRUE(p.lists);
    EXPECT_NE(p.forward_light_flags & io::kLightLists, 0U);
}

TEST(FramePlan, Deferred_NothingTransparent_EndsInTheLightingPass) {
    const auto p = plan(Renderer::kClusteredDeferred, kLit);
    EXPECT_TRUE(p.lighting_compute);
    EXPECT_FALSE(p.tonemap);
    EXPECT_FALSE(p.radiance);
    EXPECT_NE(p.lighting_output_flags & io::kOutputPixels, 0U);
    EXPECT_EQ(p.lighting_output_flags & io::kOutputRadiance, 0U);
}

TEST(FramePlan, Deferred_GlassInView_AddsBlendingAndToneMap) {
    FrameFacts facts = kLit;
    facts.transparent_visible = true;
    const auto p = plan(Renderer::kClusteredDeferred, facts);
    EXPECT_TRUE(p.transparent);
    EXPECT_TRUE(p.tonemap);
    EXPECT_TRUE(p.radiance);
    EXPECT_EQ(p.lighting_output_flags & io::kOutputPixels, 0U);
}

TEST(FramePlan, NoLights_AnyRenderer_NeitherListsNorLightCode) {
    for (uint8_t kind = 0; kind < view::kRendererNames.size(); ++kind) {
        const auto p = plan(static_cast<Renderer>(kind), {});
        EXPECT_FALSE(p.lists);
        EXPECT_EQ(p.forward_light_flags, 0U);
        EXPECT_EQ(p.lighting_light_flags, 0U);
    }
}

// Over every renderer, stage and combination of facts.
TEST(FramePlan, EveryCombination_ExactlyOnePassPacksPixels) {
    for (uint32_t bits = 0; bits < (1U << 9U); ++bits) {
        const auto has = [bits](uint32_t i) { return (bits >> i & 1U) != 0; };
        const FrameFacts facts{.wide_gbuffer = has(0),
                               .transparent_visible = has(1),
                               .local_lights = has(2),
                               .spots = has(3),
                               .directional = has(4),
                               .keep_radiance = has(5),
                               .all_lights = has(6),
                               .compute_batches = has(7),
                               .fragment_batches = has(8)};
        for (uint8_t kind = 0; kind < view::kRendererNames.size(); ++kind) {
            for (const auto stage : {LightingStage::kCompute, LightingStage::kFragment}) {
                const auto p = plan(static_cast<Renderer>(kind), facts, stage);
                const int packing = (p.tonemap ? 1 : 0) +
                                    ((p.lighting_output_flags & io::kOutputPixels) != 0 ? 1 : 0) +
                                    ((p.toon_output_flags & io::kOutputPixels) != 0 ? 1 : 0);
                ASSERT_EQ(packing, 1);
                ASSERT_NE(p.forward, p.gbuffer);
                ASSERT_EQ(p.gbuffer, p.lighting_compute || p.lighting_fragment);
                // Whoever reads radiance finds it written, and asked for.
                const bool reads = p.tonemap || p.toon_pass || facts.keep_radiance;
                ASSERT_EQ(p.radiance, reads);
                if (reads && p.lighting_compute) {
                    ASSERT_NE(p.lighting_output_flags & io::kOutputRadiance, 0U);
                }
                if (p.toon_pass && (p.tonemap || facts.keep_radiance)) {
                    ASSERT_NE(p.toon_output_flags & io::kOutputRadiance, 0U);
                }
                ASSERT_FALSE(facts.all_lights && p.lists);
            }
        }
    }
}

} // namespace froxel::render

#include "interface/constants.h"
#include "interface/fog_io.h"
#include "interface/gbuffer_io.h"
#include "render/effects/background.h"
#include "render/effects/bloom.h"
#include "render/effects/environment.h"
#include "render/effects/exposure.h"
#include "render/effects/fog.h"
#include "render/effects/fog_plan.h"
#include "render/effects/fxaa.h"
#include "render/effects/shadows.h"
#include "render/frame/frame_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace froxel::render {

namespace {

using settings::LightingStage;
using settings::Renderer;

FramePlan
plan(Renderer renderer, const FrameFacts& facts, LightingStage stage = LightingStage::kCompute) {
    settings::ViewSettings settings;
    settings.renderer = renderer;
    settings.lighting = stage;
    return planFrame(settings, facts);
}

// Null: the frame lacks it.
const EffectPlan* effectOf(const FramePlan& p, const EffectRow& row) {
    const auto at =
        std::ranges::find_if(p.effects, [&row](const auto& it) { return it.row == &row; });
    return at != p.effects.end() ? &at->plan : nullptr;
}

settings::BloomKind bloomOf(const FramePlan& p) {
    const EffectPlan* bloom = effectOf(p, kBloomEffect);
    return bloom != nullptr ? static_cast<settings::BloomKind>(bloom->way)
                            : settings::BloomKind::kNone;
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

TEST(FramePlan, ForwardPlus_WithLights_HasListsAndAPrepassThatPays) {
    FrameFacts facts = kLit;
    EXPECT_FALSE(plan(Renderer::kForwardPlus, facts).depth_prepass);
    facts.prepass_pays = true;
    const auto p = plan(Renderer::kForwardPlus, facts);
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

TEST(FramePlan, Transparency_IsPlannedWhereSomethingIsBlended) {
    settings::ViewSettings settings;
    settings.transparency = settings::Transparency::kPeeled;
    settings.peel_layers = 6;
    const auto usual = planFrame({}, kLit);
    EXPECT_EQ(planFrame(settings, kLit), usual);
    FrameFacts facts = kLit;
    facts.transparent_visible = true;
    EXPECT_EQ(planFrame(settings, facts).transparency, settings::Transparency::kPeeled);
    EXPECT_EQ(planFrame(settings, facts).peel_layers, 6U);
    settings.transparency = settings::Transparency::kWeighted;
    EXPECT_EQ(planFrame(settings, facts).transparency, settings::Transparency::kWeighted);
    EXPECT_EQ(planFrame(settings, facts).peel_layers, 0U);
    settings.debug.view = settings::DebugView::kNormal; // shows no blended surface
    EXPECT_FALSE(planFrame(settings, facts).transparent);
    EXPECT_EQ(planFrame(settings, facts).transparency, settings::Transparency::kSorted);
}

TEST(FramePlan, NoLights_AnyRenderer_NeitherListsNorLightCode) {
    for (uint8_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
        const auto p = plan(static_cast<Renderer>(kind), {});
        EXPECT_FALSE(p.lists);
        EXPECT_EQ(p.forward_light_flags, 0U);
        EXPECT_EQ(p.lighting_light_flags, 0U);
    }
}

namespace {

bool has(uint64_t flags, uint64_t flag) {
    return (flags & flag) != 0;
}

// The first that does not hold; empty: all do.
std::string_view firstBroken(std::span<const std::pair<bool, const char*>> rules) {
    for (const auto& [holds, rule] : rules) {
        if (!holds) {
            return rule;
        }
    }
    return {};
}

// What must hold of surfaces with layers.
std::string_view brokenLayerRule(const settings::ViewSettings& settings,
                                 const FrameFacts& facts,
                                 const FramePlan& p) {
    const std::pair<bool, const char*> rules[] = {
        {p.layers == (facts.layers_visible && p.gbuffer &&
                      settings.shading != settings::ShadingModel::kLambert),
         "layers over a G-buffer's surfaces, where the model has any"},
        {!p.layers || p.tonemap, "tones are mapped after layers"},
        {has(p.gbuffer_unused_material_flags, kLayerFlags), "no layers in a G-buffer"},
        {has(p.forward_unused_material_flags, kLayerFlags) ==
             (settings.shading == settings::ShadingModel::kLambert),
         "the shader of layers where they are seen"},
    };
    return firstBroken(rules);
}

// What must hold of every plan; empty when it does.
std::string_view brokenPassRule(const settings::ViewSettings& settings,
                                const FrameFacts& facts,
                                const FramePlan& p) {
    const bool compute_lights = p.lighting_compute || p.visibility_shade;
    const bool lighting_packs = has(p.lighting_output_flags, io::kOutputPixels);
    const bool toon_packs = has(p.toon_output_flags, io::kOutputPixels);
    const bool lighting_stores = has(p.lighting_output_flags, io::kOutputRadiance);
    const bool toon_stores = has(p.toon_output_flags, io::kOutputRadiance);
    const std::pair<bool, const char*> rules[] = {
        {p.forward + p.gbuffer + p.visibility_shade == 1, "solid surfaces are shaded in one way"},
        {p.gbuffer == (p.lighting_compute || p.lighting_fragment), "a G-buffer is lit"},
        {!(p.lighting_compute && p.lighting_fragment), "in one stage"},
        {!p.lighting_fragment || settings.lighting == LightingStage::kFragment ||
             (settings.lighting == LightingStage::kAuto && facts.whole_groups &&
              !facts.local_lights &&
              settings.environment.light != settings::EnvironmentLight::kOff),
         "the fragment stage lights a G-buffer where asked to, or from around alone"},
        {!p.depth_prepass || (facts.prepass_pays && (p.forward || (p.gbuffer && !p.visibility))),
         "depth is rastered first only where that pays and the rasteriser shades"},
        {!p.depth_prepass || settings.renderer != Renderer::kNaive, "naive has no prepass"},
        {p.count_samples == (facts.overdraw_unknown && !p.visibility),
         "samples are counted until the overdraw is known"},
        {!p.visibility_shade || (p.visibility && isForward(settings.renderer)),
         "only forward renderers shade from ids"},
        {p.visibility == facts.visibility, "ids are drawn where they can be"},
        {p.compute_raster == (facts.visibility && facts.compute_raster),
         "in compute where that was chosen"},
        {p.toon_pass == (settings.renderer == Renderer::kToonCompute), "toon_compute has its pass"},
        {p.transparent == facts.transparent_visible, "blending only where something is blended"},
        {p.tonemap + lighting_packs + toon_packs == 1, "exactly one pass packs pixels"},
        {!p.transparent || p.tonemap, "tones are mapped after blending"},
        {p.tonemap || compute_lights || p.toon_pass, "only compute passes map tones on the way"},
        {p.tonemap || !p.toon_pass || toon_packs, "the toon pass is the last"},
        {p.radiance == (p.tonemap || p.toon_pass || facts.keep_radiance),
         "the radiance target is there if somebody reads it"},
        {p.radiance || (!lighting_stores && !toon_stores), "nothing is stored for nobody"},
        {lighting_stores == (p.radiance && compute_lights), "whoever reads radiance finds it"},
        {toon_stores == (p.toon_pass && (p.tonemap || facts.keep_radiance)),
         "and finds what the toon pass made of it"},
        {!p.lists || (facts.local_lights && !facts.all_lights), "lists only of local lights"},
        {!p.lists || settings.renderer != Renderer::kNaive, "naive has no lists"},
        {p.count_pairs == (settings.count_pairs && facts.local_lights),
         "pairs are counted where asked and there are any"},
        {p.gbuffer || p.gbuffer_output_flags == 0, "no layout without a G-buffer"},
        {!p.gbuffer || has(p.gbuffer_output_flags, io::kOutputWideGbuffer) == facts.wide_gbuffer,
         "wide if the scene needs it"},
        {has(p.gbuffer_output_flags, io::kOutputSpecular) ==
             (p.gbuffer && facts.specular && !isForward(settings.renderer) &&
              settings.shading != settings::ShadingModel::kLambert),
         "what dielectrics reflect where it is shown"},
        {has(p.lighting_light_flags, io::kLightEdges) ==
             (facts.edges && settings.shading != settings::ShadingModel::kLambert),
         "edges where one reflects less than all"},
        {!p.gbuffer || (p.lighting_output_flags & p.gbuffer_output_flags) == p.gbuffer_output_flags,
         "lighting reads the layout that was written"},
    };
    return firstBroken(rules);
}

// The same of its effects.
std::string_view brokenEffectRule(const settings::ViewSettings& settings,
                                  const FrameFacts& facts,
                                  const FramePlan& p) {
    const bool is_toon = isToon(settings.renderer);
    const EffectPlan* shadows = effectOf(p, kShadowsEffect);
    const EffectPlan* fog = effectOf(p, kFogEffect);
    const uint32_t fog_way = fog != nullptr ? fog->way : 0;
    const std::pair<bool, const char*> rules[] = {
        {has(p.tonemap_output_flags, io::kOutputClamp) ==
             (settings.tone_map == settings::ToneMap::kClamp),
         "the tone map asked for"},
        {p.outline == (is_toon && settings.toon_outline.strength > 0),
         "outlines where a toon renderer is asked for them"},
        {p.toon_bands == (p.toon_pass && settings.toon.bands > 0), "the colour's bands"},
        {bloomOf(p) == settings.bloom.kind, "the bloom asked for"},
        {(effectOf(p, kExposureEffect) != nullptr) ==
             (settings.exposure_mode == settings::ExposureMode::kFrame),
         "exposure is metered where asked for"},
        {has(shadows != nullptr ? shadows->way : 0, kShadowsDrawn) ==
             (facts.shadows && facts.local_lights),
         "maps of lights that have them"},
        {p.samples == (settings.antialiasing == settings::Antialiasing::kSsaa4),
         "four samples where asked for"},
        {p.samples == has(p.tonemap_output_flags, io::kOutputSamples),
         "which the tone map averages"},
        {(effectOf(p, kFxaaEffect) != nullptr) ==
             (settings.antialiasing == settings::Antialiasing::kFxaa),
         "the filter asked for"},
        {(fog != nullptr) == settings.fog.present(), "fog where there is a medium"},
        {has(fog_way, kFogVolume) == (settings.fog.scatters() && facts.local_lights),
         "a volume where it scatters lights"},
        {has(fog_way, kFogNoise) == (has(fog_way, kFogVolume) && settings.fog.noise),
         "jittered where asked for"},
        {has(p.blended_output_flags, io::kOutputFog) == (fog != nullptr) &&
             has(p.blended_output_flags, io::kOutputFogVolume) == has(fog_way, kFogVolume),
         "who looks through it knows what there is"},
        {has(fogLightFlags(p.forward_light_flags), io::kLightLists) == p.lists, "the same lists"},
        {(fogLightFlags(p.forward_light_flags) & ~p.lighting_light_flags) == 0,
         "lights as surfaces have them"},
        {p.tonemap || fog == nullptr, "tones are mapped after fog"},
        {p.tonemap || !(p.outline || p.samples || p.hasEffect(EffectPlace::kPicture)),
         "tones are mapped after all effects on the linear picture"},
    };
    return firstBroken(rules);
}

// Of the flags of a pass that adds up lights.
std::string_view brokenLightRule(const settings::ViewSettings& settings,
                                 const FrameFacts& facts,
                                 const FramePlan& p,
                                 uint32_t flags) {
    const bool local = has(flags, io::kLightLocal);
    const bool lists = has(flags, io::kLightLists);
    const bool any = local || has(flags, io::kLightDirectional);
    const uint32_t laws = io::kLightSlicesLinear | io::kLightSlicesHyperbolic;
    const uint32_t of_local = io::kLightLists | io::kLightSpots | io::kLightBatched |
                              io::kLightPartial | io::kLightEqualRadii | io::kLightCulled |
                              io::kLightLong | io::kLightShadows | io::kLightSmallScene | laws;
    const std::pair<bool, const char*> rules[] = {
        {local == facts.local_lights, "local light code if there are any"},
        {local || (flags & of_local) == 0, "nothing of local lights without one"},
        {has(flags, io::kLightDirectional) == facts.directional, "suns if there are any"},
        {lists == p.lists, "lists are read if they are made"},
        {has(flags, io::kLightSpots) == (local && facts.spots), "cones if there are spots"},
        {has(flags, io::kLightAreas) == (local && facts.areas), "rectangles if there are any"},
        {has(flags, io::kLightShadows) == (facts.shadows && facts.local_lights),
         "maps are read if they are drawn"},
        {has(flags, io::kLightSmallScene) == (local && facts.small_scene),
         "a floor of the scene's own if it is small"},
        {has(flags, io::kLightEqualRadii) == (local && facts.equal_radii),
         "a constant radius if there is one"},
        {lists || (flags & laws) == 0, "no slices without lists"},
        {(flags & laws) != laws, "one slice law"},
        {!has(flags, io::kLightPartial) || has(flags, io::kLightBatched), "partial batches"},
        {!has(flags, io::kLightCulled) || (lists && has(flags, io::kLightBatched)),
         "only batches of lists are culled"},
        {!has(flags, io::kLightBatched) || facts.compute_batches || facts.fragment_batches,
         "batches if a subgroup can"},
        {has(flags, io::kLightToon) == (any && settings.renderer == Renderer::kToonFragment),
         "the ramp if there is light to bend"},
        {has(flags, io::kLightBands) == (has(flags, io::kLightToon) && settings.toon.bands > 0),
         "each light's bands with its ramp"},
        {has(flags, io::kLightRim) == (any && isToon(settings.renderer) && settings.toon.rim > 0),
         "a rim if there is light to add"},
        {has(flags, io::kLightLambert) == (settings.shading == settings::ShadingModel::kLambert),
         "lambert where it is asked for"},
        {has(flags, io::kLightBlinnPhong) ==
             (settings.shading == settings::ShadingModel::kBlinnPhong),
         "blinn_phong where it is asked for"},
    };
    return firstBroken(rules);
}

std::string_view
brokenRule(const settings::ViewSettings& settings, const FrameFacts& facts, const FramePlan& p) {
    for (const std::string_view broken :
         {brokenPassRule(settings, facts, p), brokenLayerRule(settings, facts, p),
          brokenEffectRule(settings, facts, p),
          brokenLightRule(settings, facts, p, p.forward_light_flags),
          brokenLightRule(settings, facts, p, p.lighting_light_flags)}) {
        if (!broken.empty()) {
            return broken;
        }
    }
    const bool in_compute = p.lighting_compute || p.visibility_shade;
    if (in_compute && has(p.lighting_light_flags, io::kLightPartial)) {
        return "whole subgroups in compute";
    }
    return {};
}

} // namespace

// The key of a frame is a pure function: every combination of settings that it looks at and of
// facts, by the rules above.
TEST(FramePlan, EveryCombination_KeepsTheRules) {
    constexpr uint32_t kFacts = 15;
    settings::ViewSettings settings;
    for (uint32_t setting = 0; setting < 5 * 3 * 3 * 2 * 3 * 2; ++setting) {
        uint32_t rest = setting;
        const auto next = [&rest](uint32_t count) {
            const uint32_t value = rest % count;
            rest /= count;
            return value;
        };
        settings.renderer = static_cast<Renderer>(next(5));
        settings.lighting = static_cast<LightingStage>(next(3));
        settings.shading =
            static_cast<settings::ShadingModel>(next(settings::kShadingModelNames.size()));
        settings.tone_map = static_cast<settings::ToneMap>(next(2));
        settings.grid.law = static_cast<settings::GridLaw>(next(3));
        settings.count_pairs = next(2) != 0;
        for (uint32_t bits = 0; bits < (1U << kFacts); ++bits) {
            const auto has = [bits](uint32_t i) { return (bits >> i & 1U) != 0; };
            const FrameFacts facts{.wide_gbuffer = has(0),
                                   .specular = has(1) != has(7),
                                   .edges = has(4) != has(14),
                                   .layers_visible = has(8) != has(2),
                                   .transparent_visible = has(1),
                                   .local_lights = has(2),
                                   .spots = has(3),
                                   .areas = has(3) && has(0),
                                   .equal_radii = has(4),
                                   .small_scene = has(6),
                                   .long_loops = has(5),
                                   .directional = has(6),
                                   .keep_radiance = has(7),
                                   .all_lights = has(8),
                                   .compute_batches = has(9),
                                   .fragment_batches = has(10),
                                   .culled_batches = has(11),
                                   .visibility = has(12),
                                   .compute_raster = !has(13),
                                   .cull_meshlets = has(13),
                                   .prepass_pays = has(14),
                                   .overdraw_unknown = has(14) != has(0)};
            const auto p = planFrame(settings, facts);
            ASSERT_EQ(brokenRule(settings, facts, p), "")
                << "settings " << setting << ", facts " << bits;
            ASSERT_EQ(p, planFrame(settings, facts));
        }
    }
}

TEST(FramePlan, WorkOnTheLitPicture_KeepsTheRules) {
    settings::ViewSettings settings;
    for (uint32_t setting = 0; setting < 5 * 3 * 3 * 2 * 2 * 4 * 2; ++setting) {
        const uint32_t fog = setting / 180 % 4;
        settings.fog.density = fog != 0 ? 0.5F : 0.0F;
        settings.fog.albedo = glm::vec3(fog == 1 ? 0.0F : 0.5F);
        settings.fog.noise = fog == 3;
        settings.exposure_mode = static_cast<settings::ExposureMode>(setting / 720);
        settings.renderer = static_cast<Renderer>(setting % 5);
        settings.lighting = static_cast<LightingStage>(setting / 5 % 3);
        settings.antialiasing = static_cast<settings::Antialiasing>(setting / 15 % 3);
        settings.bloom.kind =
            setting / 45 % 2 != 0 ? settings::BloomKind::kMipChain : settings::BloomKind::kNone;
        settings.toon_outline.strength = setting / 90 % 2 != 0 ? 0.5F : 0.0F;
        settings.toon.bands = setting / 45 % 2 != 0 ? 4 : 0;
        settings.toon.rim = setting / 15 % 2 != 0 ? 0.5F : 0.0F;
        for (uint32_t bits = 0; bits < 128; ++bits) {
            const auto has = [bits](uint32_t i) { return (bits >> i & 1U) != 0; };
            const FrameFacts facts{.transparent_visible = has(0),
                                   .local_lights = has(1),
                                   .shadows = has(4),
                                   .keep_radiance = has(2),
                                   .whole_groups = has(6),
                                   .visibility = has(3)};
            settings.environment.light =
                has(5) ? settings::EnvironmentLight::kStudio : settings::EnvironmentLight::kOff;
            ASSERT_EQ(brokenRule(settings, facts, planFrame(settings, facts)), "")
                << "settings " << setting << ", facts " << bits;
        }
    }
}

TEST(FramePlan, MeshesThatBend_ArePosedInEveryFrame) {
    settings::ViewSettings settings;
    for (const auto debug : {settings::DebugView::kNone, settings::DebugView::kDepth,
                             settings::DebugView::kOverdraw}) {
        settings.debug.view = debug;
        EXPECT_TRUE(planFrame(settings, {.bends = true}).pose);
        EXPECT_FALSE(planFrame(settings, {}).pose);
    }
}

TEST(FramePlan, FogOfNoDensity_IsNotThere) {
    settings::ViewSettings settings;
    const FrameFacts facts{.local_lights = true, .directional = true};
    const FramePlan without = planFrame(settings, facts);
    settings.fog = {.density = 0, .height_falloff = 1, .half_rate = true, .noise = true};
    EXPECT_EQ(planFrame(settings, facts), without);
}

TEST(FramePlan, Environment_IsAFlagOfWhatLightsSurfacesAndNoPass) {
    settings::ViewSettings settings;
    for (uint8_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
        settings = {};
        settings.renderer = static_cast<Renderer>(kind);
        const FramePlan off = planFrame(settings, kLit);
        settings.environment.strength = 2;
        EXPECT_EQ(planFrame(settings, kLit), off);
        settings.environment.light = settings::EnvironmentLight::kStudio;
        FramePlan studio = planFrame(settings, kLit);
        EXPECT_EQ(studio.forward_light_flags, off.forward_light_flags | io::kLightEnvironment);
        EXPECT_EQ(studio.lighting_light_flags, off.lighting_light_flags | io::kLightEnvironment);
        EXPECT_NE(effectOf(studio, kEnvironmentEffect), nullptr);
        studio.effects = off.effects;
        studio.forward_light_flags = off.forward_light_flags;
        studio.lighting_light_flags = off.lighting_light_flags;
        EXPECT_EQ(studio, off);
    }
    settings.renderer = Renderer::kClusteredDeferred;
    settings.debug.view = settings::DebugView::kBaseColor;
    EXPECT_EQ(effectOf(planFrame(settings, kLit), kEnvironmentEffect), nullptr);
}

// Empty pixels cost a software device nothing there.
TEST(FramePlan, LightFromAroundAlone_OnASoftwareDevice_IsInTheFragmentStage) {
    settings::ViewSettings settings;
    settings.environment.light = settings::EnvironmentLight::kStudio;
    FrameFacts facts{.compute_batches = true, .whole_groups = true};
    EXPECT_TRUE(planFrame(settings, facts).lighting_fragment);
    facts.local_lights = true;
    EXPECT_TRUE(planFrame(settings, facts).lighting_compute);
    facts = {.compute_batches = true};
    EXPECT_TRUE(planFrame(settings, facts).lighting_compute);
    facts.whole_groups = true;
    settings.lighting = LightingStage::kCompute;
    EXPECT_TRUE(planFrame(settings, facts).lighting_compute);
    settings.lighting = LightingStage::kAuto;
    settings.environment.light = settings::EnvironmentLight::kOff;
    EXPECT_TRUE(planFrame(settings, facts).lighting_compute);
}

TEST(FramePlan, Background_IsThereWithAnEnvironment) {
    settings::ViewSettings settings;
    settings.environment.background = true;
    EXPECT_EQ(effectOf(planFrame(settings, kLit), kBackgroundEffect), nullptr);
    settings.environment.light = settings::EnvironmentLight::kStudio;
    const FramePlan shown = planFrame(settings, kLit);
    EXPECT_NE(effectOf(shown, kBackgroundEffect), nullptr);
    EXPECT_TRUE(shown.radiance && shown.tonemap);
    settings.debug.view = settings::DebugView::kBaseColor;
    EXPECT_EQ(effectOf(planFrame(settings, kLit), kBackgroundEffect), nullptr);
}

TEST(FramePlan, BloomOfNoStrength_IsNone) {
    settings::ViewSettings settings;
    settings.bloom.kind = settings::BloomKind::kSeparable;
    settings.bloom.strength = 0;
    EXPECT_EQ(bloomOf(planFrame(settings, {})), settings::BloomKind::kNone);
}

// A fixed exposure leaves the frame as it is; a metered one needs the linear picture, and a debug
// view has none.
TEST(FramePlan, MeteredExposure_AsksForRadianceAndAToneMap) {
    settings::ViewSettings settings;
    const FramePlan fixed = planFrame(settings, kLit);
    settings.exposure = 8;
    EXPECT_EQ(planFrame(settings, kLit), fixed);
    settings.exposure_mode = settings::ExposureMode::kFrame;
    const FramePlan metered = planFrame(settings, kLit);
    EXPECT_TRUE(metered.tonemap && metered.radiance);
    EXPECT_EQ(metered.tonemap_output_flags, planFrame({}, {}).tonemap_output_flags);
    settings.debug.view = settings::DebugView::kDepth;
    EXPECT_TRUE(planFrame(settings, kLit).effects.empty());
}

TEST(FramePlan, Exposure_IsMeteredBeforeBloom) {
    settings::ViewSettings settings;
    settings.exposure_mode = settings::ExposureMode::kFrame;
    settings.bloom.kind = settings::BloomKind::kMipChain;
    const auto plan = planFrame(settings, kLit);
    ASSERT_EQ(plan.effects.size(), 2U);
    EXPECT_EQ(plan.effects[0].row, &kExposureEffect);
    EXPECT_EQ(plan.effects[1].row, &kBloomEffect);
}

TEST(FramePlan, DrawnSize_IsTwiceTheSidesForFourSamples) {
    settings::ViewSettings settings;
    settings.size = {101, 57};
    EXPECT_EQ(drawnSize(settings), settings.size);
    settings.antialiasing = settings::Antialiasing::kSsaa4;
    EXPECT_EQ(drawnSize(settings), (settings::Size{202, 114}));
}

TEST(FramePlan, GenericParts_OnlyWiden) {
    const FrameFacts bare{.local_lights = true, .equal_radii = true, .compute_batches = true};
    EXPECT_EQ(generalised(bare, {}), bare);
    const auto wide = generalised(bare, {.spots = true,
                                         .directional = true,
                                         .wide_gbuffer = true,
                                         .transparent = true,
                                         .uneven_radii = true});
    EXPECT_TRUE(wide.spots && wide.directional && wide.wide_gbuffer && wide.transparent_visible);
    EXPECT_FALSE(wide.equal_radii);
    EXPECT_FALSE(generalised({}, {.spots = true}).spots); // no light to have a cone
}

TEST(FramePlan, DebugViews_InThePicturesPlace_DrawSurfacesAndNoLight) {
    settings::ViewSettings settings;
    FrameFacts facts = kLit;
    facts.transparent_visible = true;
    settings.renderer = Renderer::kForwardPlus;
    settings.debug.view = settings::DebugView::kListedLights;
    const auto lists = planFrame(settings, facts);
    EXPECT_TRUE(lists.depth_prepass);
    EXPECT_TRUE(lists.lists);
    EXPECT_FALSE(lists.forward || lists.gbuffer || lists.transparent || lists.tonemap ||
                 lists.radiance);
    settings.debug.view = settings::DebugView::kNormal;
    const auto normal = planFrame(settings, facts);
    EXPECT_TRUE(normal.gbuffer);
    EXPECT_FALSE(normal.lighting_compute || normal.lighting_fragment || normal.lists);
    settings.renderer = Renderer::kToonCompute;
    settings.debug.view = settings::DebugView::kOverdraw;
    const auto overdraw = planFrame(settings, facts);
    EXPECT_TRUE(overdraw.radiance);
    EXPECT_FALSE(overdraw.gbuffer || overdraw.depth_prepass || overdraw.toon_pass);
    settings.renderer = Renderer::kNaive;
    settings.debug.view = settings::DebugView::kEvaluatedLights;
    EXPECT_FALSE(planFrame(settings, facts).lists); // it loops over all
}

TEST(FramePlan, DebugViews_OverThePicture_AddRadianceAndAToneMap) {
    settings::ViewSettings settings;
    settings.lighting = LightingStage::kCompute;
    settings.debug.view = settings::DebugView::kLightSpheres;
    const auto p = planFrame(settings, kLit);
    EXPECT_TRUE(p.lighting_compute && p.radiance && p.tonemap);
    settings.debug.view = settings::DebugView::kNone;
    EXPECT_FALSE(planFrame(settings, kLit).tonemap);
}

} // namespace froxel::render

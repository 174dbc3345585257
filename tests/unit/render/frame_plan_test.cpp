#include "interface/constants.h"
#include "interface/fog_io.h"
#include "interface/gbuffer_io.h"
#include "render/frame/frame_plan.h"
#include "render/steps/fog.h"
#include "render/steps/fog_plan.h"
#include "render/steps/order.h"
#include "render/steps/shadows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace froxel::render {

namespace {

using settings::LightingStage;
using settings::Renderer;

FramePlan planOf(const settings::ViewSettings& settings, const FrameFacts& facts) {
    return planFrame(settings, facts, kOrder);
}

FramePlan
plan(Renderer renderer, const FrameFacts& facts, LightingStage stage = LightingStage::kCompute) {
    settings::ViewSettings settings;
    settings.renderer = renderer;
    settings.lighting = stage;
    return planOf(settings, facts);
}

bool has(const FramePlan& p, const StepRow& row) {
    return p.find(row) != nullptr;
}

// The step that packs pixels for the host; null: none.
const PlannedStep* packer(const FramePlan& p) {
    const auto at = std::ranges::find_if(
        p.steps, [](const PlannedStep& step) { return step.plan.packs == Resource::kPixels; });
    return at != p.steps.end() ? &*at : nullptr;
}

// Whether radiance of the frame is stored.
bool storesRadiance(const FramePlan& p) {
    return p.uses(Resource::kRadiance);
}

settings::BloomKind bloomOf(const FramePlan& p) {
    const StepPlan* bloom = p.find(kBloomStep);
    return bloom != nullptr ? static_cast<settings::BloomKind>(bloom->way)
                            : settings::BloomKind::kNone;
}

constexpr FrameFacts kLit{.lights = io::kLightLocal, .compute_batches = true};

} // namespace

TEST(FramePlan, Naive_WithLights_IsForwardWithoutListsOrPrepass) {
    const auto p = plan(Renderer::kNaive, kLit);
    EXPECT_TRUE(has(p, kForwardStep));
    EXPECT_FALSE(has(p, kDepthStep));
    EXPECT_FALSE(p.lists);
    EXPECT_EQ(p.forward_light_flags & io::kLightLists, 0U);
    EXPECT_TRUE(has(p, kTonemapStep));
}

TEST(FramePlan, ForwardPlus_WithLights_HasListsAndAPrepassThatPays) {
    FrameFacts facts = kLit;
    EXPECT_FALSE(has(plan(Renderer::kForwardPlus, facts), kDepthStep));
    facts.prepass_pays = true;
    const auto p = plan(Renderer::kForwardPlus, facts);
    EXPECT_TRUE(has(p, kDepthStep));
    EXPECT_TRUE(p.lists);
    EXPECT_NE(p.forward_light_flags & io::kLightLists, 0U);
}

TEST(FramePlan, Deferred_NothingTransparent_EndsInTheLightingPass) {
    const auto p = plan(Renderer::kClusteredDeferred, kLit);
    EXPECT_TRUE(p.lights_in_compute);
    EXPECT_FALSE(has(p, kTonemapStep));
    EXPECT_FALSE(storesRadiance(p));
    ASSERT_NE(packer(p), nullptr);
    EXPECT_EQ(packer(p)->row, &kLightingStep);
    EXPECT_FALSE(packer(p)->plan.leaves_radiance);
}

TEST(FramePlan, Deferred_GlassInView_AddsBlendingAndToneMap) {
    FrameFacts facts = kLit;
    facts.transparent_visible = true;
    const auto p = plan(Renderer::kClusteredDeferred, facts);
    EXPECT_TRUE(has(p, kBlendedStep));
    EXPECT_TRUE(storesRadiance(p));
    ASSERT_NE(packer(p), nullptr);
    EXPECT_EQ(packer(p)->row, &kTonemapStep);
}

TEST(FramePlan, TransmissiveSurfaceInView_IsDrawnBetweenBlendedOnes) {
    FrameFacts facts = kLit;
    facts.transmissive_visible = true;
    const auto alone = plan(Renderer::kClusteredDeferred, facts);
    EXPECT_TRUE(has(alone, kTransmissionDepthStep) && has(alone, kTransmissionStep));
    EXPECT_TRUE(storesRadiance(alone));
    EXPECT_FALSE(has(alone, kBlendedBehindStep) || has(alone, kBlendedStep));
    EXPECT_EQ(alone.blended_output_flags, 0U);
    EXPECT_EQ(packer(alone)->row, &kTonemapStep);
    facts.transparent_visible = true;
    const auto both = plan(Renderer::kClusteredDeferred, facts);
    EXPECT_TRUE(has(both, kBlendedBehindStep) && has(both, kBlendedStep));
    EXPECT_NE(both.blended_output_flags & io::kOutputBeforeTransmissive, 0U);
    facts.transmissive_visible = false;
    const auto blended = plan(Renderer::kClusteredDeferred, facts);
    EXPECT_FALSE(has(blended, kBlendedBehindStep) || has(blended, kTransmissionStep));
    EXPECT_EQ(blended.blended_output_flags, 0U);
}

// Ids of its layers are rastered in compute only where lights are added up there, too.
TEST(FramePlan, Transmission_IsDrawnByIdsWhereLightsAreInCompute) {
    FrameFacts facts = kLit;
    facts.geometry = SolidGeometry::kComputeIds;
    facts.transmissive_visible = true;
    const auto way = [&](settings::LightingStage stage) {
        settings::ViewSettings settings;
        settings.renderer = Renderer::kClusteredDeferred;
        settings.lighting = stage;
        return planOf(settings, facts).find(kTransmissionStep)->way;
    };
    EXPECT_EQ(way(settings::LightingStage::kCompute), 0U);
    facts.transmissive_by_ids = true;
    EXPECT_NE(way(settings::LightingStage::kCompute), 0U);
    EXPECT_EQ(way(settings::LightingStage::kFragment), 0U);
}

TEST(FramePlan, Transmission_PeelsAsManyLayersAsBlendedOnesAre) {
    FrameFacts facts = kLit;
    facts.transmissive_visible = true;
    settings::ViewSettings settings;
    settings.peel_layers = 7;
    const auto layers = [&] { return planOf(settings, facts).find(kTransmissionStep)->count; };
    EXPECT_EQ(layers(), 4U);
    settings.transparency = settings::Transparency::kPeeled;
    EXPECT_EQ(layers(), 7U);
    settings.shading = settings::ShadingModel::kLambert;
    const auto lambert = planOf(settings, facts);
    EXPECT_EQ(lambert.forward_unused_material_flags & kTransmissionFlags, 0U);
    settings.debug.view = settings::DebugView::kNormal;
    EXPECT_FALSE(has(planOf(settings, facts), kTransmissionStep));
}

TEST(FramePlan, Transparency_IsPlannedWhereSomethingIsBlended) {
    settings::ViewSettings settings;
    settings.transparency = settings::Transparency::kPeeled;
    settings.peel_layers = 6;
    const auto usual = planOf({}, kLit);
    EXPECT_EQ(planOf(settings, kLit), usual);
    FrameFacts facts = kLit;
    facts.transparent_visible = true;
    const auto blended = [&] { return *planOf(settings, facts).find(kBlendedStep); };
    const StepPlan peeled = blended();
    EXPECT_EQ(peeled.count, 6U);
    settings.transparency = settings::Transparency::kWeighted;
    const StepPlan weighted = blended();
    EXPECT_NE(weighted.way, peeled.way);
    EXPECT_EQ(weighted.count, 0U);
    settings.transparency = settings::Transparency::kSorted;
    EXPECT_NE(blended().way, weighted.way);
    settings.debug.view = settings::DebugView::kNormal; // shows no blended surface
    EXPECT_FALSE(has(planOf(settings, facts), kBlendedStep));
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

bool has(const FrameFacts& facts, uint32_t light) {
    return facts.hasLight(light);
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
        {has(p, kLayersStep) == (facts.layers_visible && p.solid == Solid::kDeferred &&
                                 settings.shading != settings::ShadingModel::kLambert),
         "layers over a G-buffer's surfaces, where the model has any"},
        {!has(p, kLayersStep) || has(p, kTonemapStep) || has(p, kToonStep),
         "tones are mapped after layers"},
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
    const bool forward = has(p, kForwardStep);
    const bool gbuffer = has(p, kGbufferStep);
    const bool depth = has(p, kDepthStep);
    const bool local = has(facts, io::kLightLocal);
    const auto packs = std::ranges::count_if(
        p.steps, [](const PlannedStep& step) { return step.plan.packs == Resource::kPixels; });
    const StepRow* packs_row = packer(p) != nullptr ? packer(p)->row : nullptr;
    // The radiance of the step that packs, behind the last one that changes it.
    const bool read_later = facts.outputs.has(Output::kRadiance);
    const std::pair<bool, const char*> rules[] = {
        {forward != gbuffer, "solid surfaces are shaded in one way"},
        {gbuffer == has(p, kLightingStep), "a G-buffer is lit"},
        {!gbuffer || p.lights_in_compute || settings.lighting == LightingStage::kFragment ||
             (settings.lighting == LightingStage::kAuto && facts.software_device && !local &&
              settings.environment.light != settings::EnvironmentLight::kOff),
         "the fragment stage lights a G-buffer where asked to, or from around alone"},
        {!depth || (facts.prepass_pays && !p.byIds()),
         "depth is rastered first only where that pays and the rasteriser shades"},
        {!depth || settings.renderer != Renderer::kNaive, "naive has no prepass"},
        {p.count_samples == (facts.overdraw_unknown && !p.byIds()),
         "samples are counted until the overdraw is known"},
        {forward == isForward(settings.renderer), "forward renderers shade at once"},
        {has(p, kIdsStep) == (facts.geometry != SolidGeometry::kRaster),
         "ids are drawn where they can be"},
        {p.uses(Resource::kWords) == (facts.geometry == SolidGeometry::kComputeIds),
         "in compute where that was chosen"},
        {has(p, kToonStep) == (settings.renderer == Renderer::kToonCompute),
         "toon_compute has its pass"},
        {has(p, kBlendedStep) == facts.transparent_visible,
         "blending only where something is blended"},
        {packs == 1, "exactly one pass packs pixels for the host"},
        {!has(p, kBlendedStep) || has(p, kTonemapStep), "tones are mapped after blending"},
        {has(p, kTonemapStep) || p.lights_in_compute || has(p, kToonStep),
         "only compute passes map tones on the way"},
        {has(p, kTonemapStep) || !has(p, kToonStep) || packs_row == &kToonStep || has(p, kFxaaStep),
         "the toon pass is the last"},
        {storesRadiance(p) ==
             (has(p, kTonemapStep) || has(p, kToonStep) || facts.outputs.has(Output::kRadiance)),
         "the radiance target is there if somebody reads it"},
        {has(p, kTonemapStep) || packer(p)->plan.filters ||
             packer(p)->plan.leaves_radiance == read_later,
         "whoever packs stores radiance for whoever reads it"},
    };
    return firstBroken(rules);
}

// Of its lists and its G-buffer.
std::string_view brokenStoreRule(const settings::ViewSettings& settings,
                                 const FrameFacts& facts,
                                 const FramePlan& p) {
    const bool gbuffer = has(p, kGbufferStep);
    const bool local = has(facts, io::kLightLocal);
    const std::pair<bool, const char*> rules[] = {
        {!p.lists || (local && facts.lists != ListPlace::kNowhere), "lists only of local lights"},
        {!p.lists || settings.renderer != Renderer::kNaive, "naive has no lists"},
        {has(p, kPairsStep) == settings.count_pairs &&
             (!settings.count_pairs || (p.find(kPairsStep)->way != 0) == local),
         "pairs are counted where asked and there are any"},
        {gbuffer || p.gbuffer_output_flags == 0, "no layout without a G-buffer"},
        {!gbuffer || has(p.gbuffer_output_flags, io::kOutputWideGbuffer) ==
                         has(facts.gbuffer, io::kOutputWideGbuffer),
         "wide if the scene needs it"},
        {has(p.gbuffer_output_flags, io::kOutputSpecular) ==
             (gbuffer && has(facts.gbuffer, io::kOutputSpecular) && !isForward(settings.renderer) &&
              settings.shading != settings::ShadingModel::kLambert),
         "what dielectrics reflect where it is shown"},
        {has(p.lighting_light_flags, io::kLightEdges) ==
             (has(facts, io::kLightEdges) && settings.shading != settings::ShadingModel::kLambert),
         "edges where one reflects less than all"},
    };
    return firstBroken(rules);
}

// The same of what effects it has.
std::string_view brokenEffectRule(const settings::ViewSettings& settings,
                                  const FrameFacts& facts,
                                  const FramePlan& p) {
    const bool is_toon = isToon(settings.renderer);
    const bool local = has(facts, io::kLightLocal);
    const StepPlan* shadows = p.find(kShadowsStep);
    const StepPlan* fog = p.find(kFogStep);
    const StepPlan* tonemap = p.find(kTonemapStep);
    const uint32_t fog_way = fog != nullptr ? fog->way : 0;
    const bool samples = settings.antialiasing == settings::Antialiasing::kSsaa4;
    const std::pair<bool, const char*> rules[] = {
        {has(p.tone_output_flags, io::kOutputClamp) ==
             (settings.tone_map == settings::ToneMap::kClamp),
         "the tone map asked for"},
        {has(p, kOutlineStep) == (is_toon && settings.toon_outline.strength > 0),
         "outlines where a toon renderer is asked for them"},
        {!has(p, kToonStep) || (p.find(kToonStep)->way != 0) == (settings.toon.bands > 0),
         "the colour's bands"},
        {bloomOf(p) == settings.bloom.kind, "the bloom asked for"},
        {has(p, kExposureStep) == (settings.exposure_mode == settings::ExposureMode::kFrame),
         "exposure is metered where asked for"},
        {has(shadows != nullptr ? shadows->way : 0, kShadowsDrawn) ==
             (has(facts, io::kLightShadows) && local),
         "maps of lights that have them"},
        {!samples || tonemap != nullptr, "four samples have a tone map"},
        {tonemap == nullptr || samples == (tonemap->way != 0), "which averages them"},
        {has(p, kFxaaStep) == (settings.antialiasing == settings::Antialiasing::kFxaa),
         "the filter asked for"},
        {(fog != nullptr) == settings.fog.present(), "fog where there is a medium"},
        {has(fog_way, kFogVolume) == (settings.fog.scatters() && local),
         "a volume where it scatters lights"},
        {has(fog_way, kFogNoise) == (has(fog_way, kFogVolume) && settings.fog.noise),
         "jittered where asked for"},
        {has(p.blended_output_flags, io::kOutputFog) == (fog != nullptr) &&
             has(p.blended_output_flags, io::kOutputFogVolume) == has(fog_way, kFogVolume),
         "who looks through it knows what there is"},
        {has(fogLightFlags(p.forward_light_flags), io::kLightLists) == p.lists, "the same lists"},
        {(fogLightFlags(p.forward_light_flags) & ~p.lighting_light_flags) == 0,
         "lights as surfaces have them"},
        {tonemap != nullptr || !(fog != nullptr || has(p, kOutlineStep) || has(p, kBloomStep)),
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
        {local == has(facts, io::kLightLocal), "local light code if there are any"},
        {local || (flags & of_local) == 0, "nothing of local lights without one"},
        {has(flags, io::kLightDirectional) == has(facts, io::kLightDirectional),
         "suns if there are any"},
        {lists == p.lists, "lists are read if they are made"},
        {has(flags, io::kLightSpots) == (local && has(facts, io::kLightSpots)),
         "cones if there are spots"},
        {has(flags, io::kLightAreas) == (local && has(facts, io::kLightAreas)),
         "rectangles if there are any"},
        {has(flags, io::kLightShadows) ==
             (has(facts, io::kLightShadows) && has(facts, io::kLightLocal)),
         "maps are read if they are drawn"},
        {has(flags, io::kLightSmallScene) == (local && has(facts, io::kLightSmallScene)),
         "a floor of the scene's own if it is small"},
        {has(flags, io::kLightEqualRadii) == (local && has(facts, io::kLightEqualRadii)),
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
         {brokenPassRule(settings, facts, p), brokenStoreRule(settings, facts, p),
          brokenLayerRule(settings, facts, p), brokenEffectRule(settings, facts, p),
          brokenLightRule(settings, facts, p, p.forward_light_flags),
          brokenLightRule(settings, facts, p, p.lighting_light_flags)}) {
        if (!broken.empty()) {
            return broken;
        }
    }
    if (p.lights_in_compute && has(p.lighting_light_flags, io::kLightPartial)) {
        return "whole subgroups in compute";
    }
    return {};
}

} // namespace

// The key of a frame is a pure function: every combination of settings that it looks at, and every
// combination of facts with some of these, by the rules above.
TEST(FramePlan, Combinations_KeepTheRules) {
    constexpr uint32_t kFacts = 15;
    constexpr uint32_t kStride = 61; // all of them would be 18 million frames
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
        for (uint32_t bits = setting % kStride; bits < (1U << kFacts); bits += kStride) {
            const auto has = [bits](uint32_t i) { return (bits >> i & 1U) != 0; };
            const auto light = [&](bool there, uint32_t flag) { return there ? flag : 0U; };
            const FrameFacts facts{
                .lights = light(has(2), io::kLightLocal) | light(has(3), io::kLightSpots) |
                          light(has(3) && has(0), io::kLightAreas) |
                          light(has(4), io::kLightEqualRadii) |
                          light(has(6), io::kLightSmallScene) | light(has(5), io::kLightLong) |
                          light(has(6), io::kLightDirectional) |
                          light(has(4) != has(14), io::kLightEdges),
                .gbuffer = light(has(0), io::kOutputWideGbuffer) |
                           light(has(1) != has(7), io::kOutputSpecular),
                .geometry = !has(12)   ? SolidGeometry::kRaster
                            : !has(13) ? SolidGeometry::kComputeIds
                                       : SolidGeometry::kIds,
                .lists = has(8) ? ListPlace::kNowhere : ListPlace::kHost,
                .outputs = has(7) ? Outputs{Output::kRadiance} : Outputs{},
                .layers_visible = has(8) != has(2),
                .transparent_visible = has(1),
                .compute_batches = has(9),
                .fragment_batches = has(10),
                .culled_batches = has(11),
                .cull_meshlets = has(13),
                .prepass_pays = has(14),
                .overdraw_unknown = has(14) != has(0)};
            ASSERT_EQ(brokenRule(settings, facts, planOf(settings, facts)), "")
                << "settings " << setting << ", facts " << bits;
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
            const FrameFacts facts{
                .lights = (has(1) ? io::kLightLocal : 0U) | (has(4) ? io::kLightShadows : 0U),
                .geometry = has(3) ? SolidGeometry::kIds : SolidGeometry::kRaster,
                .outputs = has(2) ? Outputs{Output::kRadiance} : Outputs{},
                .transparent_visible = has(0),
                .software_device = has(6)};
            settings.environment.light =
                has(5) ? settings::EnvironmentLight::kStudio : settings::EnvironmentLight::kOff;
            ASSERT_EQ(brokenRule(settings, facts, planOf(settings, facts)), "")
                << "settings " << setting << ", facts " << bits;
        }
    }
}

TEST(FramePlan, MeshesThatBend_ArePosedInEveryFrame) {
    settings::ViewSettings settings;
    for (const auto debug : {settings::DebugView::kNone, settings::DebugView::kDepth,
                             settings::DebugView::kOverdraw}) {
        settings.debug.view = debug;
        EXPECT_TRUE(has(planOf(settings, {.bends = true}), kPoseStep));
        EXPECT_FALSE(has(planOf(settings, {}), kPoseStep));
    }
}

TEST(FramePlan, FogOfNoDensity_IsNotThere) {
    settings::ViewSettings settings;
    const FrameFacts facts{.lights = io::kLightLocal | io::kLightDirectional};
    const FramePlan without = planOf(settings, facts);
    settings.fog = {.density = 0, .height_falloff = 1, .half_rate = true, .noise = true};
    EXPECT_EQ(planOf(settings, facts), without);
}

TEST(FramePlan, Environment_IsAFlagOfWhatLightsSurfacesAndNoPass) {
    settings::ViewSettings settings;
    for (uint8_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
        settings = {};
        settings.renderer = static_cast<Renderer>(kind);
        const FramePlan off = planOf(settings, kLit);
        settings.environment.strength = 2;
        EXPECT_EQ(planOf(settings, kLit), off);
        settings.environment.light = settings::EnvironmentLight::kStudio;
        FramePlan studio = planOf(settings, kLit);
        EXPECT_EQ(studio.forward_light_flags, off.forward_light_flags | io::kLightEnvironment);
        EXPECT_EQ(studio.lighting_light_flags, off.lighting_light_flags | io::kLightEnvironment);
        EXPECT_TRUE(has(studio, kEnvironmentStep));
        std::erase_if(studio.steps, [](const auto& it) { return it.row == &kEnvironmentStep; });
        for (PlannedStep& step : studio.steps) {
            step.plan.light_flags = 0;
        }
        studio.forward_light_flags = off.forward_light_flags;
        studio.lighting_light_flags = off.lighting_light_flags;
        EXPECT_EQ(studio, off);
    }
    settings.renderer = Renderer::kClusteredDeferred;
    settings.debug.view = settings::DebugView::kBaseColor;
    EXPECT_FALSE(has(planOf(settings, kLit), kEnvironmentStep));
}

// Empty pixels cost a software device nothing there.
TEST(FramePlan, LightFromAroundAlone_OnASoftwareDevice_IsInTheFragmentStage) {
    settings::ViewSettings settings;
    settings.environment.light = settings::EnvironmentLight::kStudio;
    FrameFacts facts{.compute_batches = true, .software_device = true};
    const auto in_compute = [&] { return planOf(settings, facts).lights_in_compute; };
    EXPECT_FALSE(in_compute());
    facts.lights = io::kLightLocal;
    EXPECT_TRUE(in_compute());
    facts = {.compute_batches = true};
    EXPECT_TRUE(in_compute());
    facts.software_device = true;
    settings.lighting = LightingStage::kCompute;
    EXPECT_TRUE(in_compute());
    settings.lighting = LightingStage::kAuto;
    settings.environment.light = settings::EnvironmentLight::kOff;
    EXPECT_TRUE(in_compute());
}

TEST(FramePlan, Background_IsThereWithAnEnvironment) {
    settings::ViewSettings settings;
    settings.environment.background = true;
    EXPECT_FALSE(has(planOf(settings, kLit), kBackgroundStep));
    settings.environment.light = settings::EnvironmentLight::kStudio;
    const FramePlan shown = planOf(settings, kLit);
    EXPECT_TRUE(has(shown, kBackgroundStep));
    EXPECT_TRUE(storesRadiance(shown) && has(shown, kTonemapStep));
    settings.debug.view = settings::DebugView::kBaseColor;
    EXPECT_FALSE(has(planOf(settings, kLit), kBackgroundStep));
}

TEST(FramePlan, BloomOfNoStrength_IsNone) {
    settings::ViewSettings settings;
    settings.bloom.kind = settings::BloomKind::kSeparable;
    settings.bloom.strength = 0;
    EXPECT_EQ(bloomOf(planOf(settings, {})), settings::BloomKind::kNone);
}

// A fixed exposure leaves the frame as it is; a metered one needs the linear picture, and a debug
// view has none.
TEST(FramePlan, MeteredExposure_AsksForRadianceAndAToneMap) {
    settings::ViewSettings settings;
    const FramePlan fixed = planOf(settings, kLit);
    settings.exposure = 8;
    EXPECT_EQ(planOf(settings, kLit), fixed);
    settings.exposure_mode = settings::ExposureMode::kFrame;
    const FramePlan metered = planOf(settings, kLit);
    EXPECT_TRUE(has(metered, kTonemapStep) && storesRadiance(metered));
    EXPECT_EQ(metered.tone_output_flags, fixed.tone_output_flags);
    settings.debug.view = settings::DebugView::kDepth;
    EXPECT_FALSE(has(planOf(settings, kLit), kExposureStep));
}

TEST(FramePlan, Exposure_IsMeteredBeforeBloom) {
    settings::ViewSettings settings;
    settings.exposure_mode = settings::ExposureMode::kFrame;
    settings.bloom.kind = settings::BloomKind::kMipChain;
    const auto plan = planOf(settings, kLit);
    const auto at = [&](const StepRow& row) {
        return std::ranges::find(plan.steps, &row, &PlannedStep::row);
    };
    ASSERT_NE(at(kBloomStep), plan.steps.end());
    EXPECT_LT(at(kExposureStep), at(kBloomStep));
}

TEST(FramePlan, DrawnSize_IsTwiceTheSidesForFourSamples) {
    settings::ViewSettings settings;
    settings.size = {101, 57};
    EXPECT_EQ(frameSize(settings), (FrameSize{settings.size, settings.size}));
    settings.antialiasing = settings::Antialiasing::kSsaa4;
    EXPECT_EQ(frameSize(settings), (FrameSize{{202, 114}, settings.size}));
}

TEST(FramePlan, GenericParts_OnlyWiden) {
    const FrameFacts bare{.lights = io::kLightLocal | io::kLightEqualRadii,
                          .compute_batches = true};
    EXPECT_EQ(generalised(bare, {}), bare);
    const auto wide = generalised(bare, {.spots = true,
                                         .directional = true,
                                         .wide_gbuffer = true,
                                         .transparent = true,
                                         .uneven_radii = true});
    EXPECT_EQ(wide.lights, io::kLightLocal | io::kLightSpots | io::kLightDirectional);
    EXPECT_TRUE(has(wide.gbuffer, io::kOutputWideGbuffer) && wide.transparent_visible);
    EXPECT_EQ(generalised({}, {.spots = true}).lights, 0U); // no light to have a cone
}

TEST(FramePlan, DebugViews_InThePicturesPlace_DrawSurfacesAndNoLight) {
    settings::ViewSettings settings;
    FrameFacts facts = kLit;
    facts.transparent_visible = true;
    settings.renderer = Renderer::kForwardPlus;
    settings.debug.view = settings::DebugView::kListedLights;
    const auto lists = planOf(settings, facts);
    EXPECT_TRUE(has(lists, kDepthStep));
    EXPECT_TRUE(lists.lists);
    EXPECT_FALSE(has(lists, kForwardStep) || has(lists, kGbufferStep) || has(lists, kBlendedStep) ||
                 has(lists, kTonemapStep) || storesRadiance(lists));
    settings.debug.view = settings::DebugView::kNormal;
    const auto normal = planOf(settings, facts);
    EXPECT_TRUE(has(normal, kGbufferStep));
    EXPECT_FALSE(has(normal, kLightingStep) || normal.lists);
    settings.renderer = Renderer::kToonCompute;
    for (const auto debug : {settings::DebugView::kOverdraw, settings::DebugView::kInstances}) {
        settings.debug.view = debug;
        const auto fragments = planOf(settings, facts);
        EXPECT_TRUE(storesRadiance(fragments) && has(fragments, kFragmentsStep));
        EXPECT_FALSE(has(fragments, kGbufferStep) || has(fragments, kDepthStep) ||
                     has(fragments, kBlendedStep) || has(fragments, kToonStep));
    }
    settings.renderer = Renderer::kNaive;
    settings.debug.view = settings::DebugView::kEvaluatedLights;
    EXPECT_FALSE(planOf(settings, facts).lists); // it loops over all
}

TEST(FramePlan, DebugViews_OverThePicture_AddRadianceAndAToneMap) {
    settings::ViewSettings settings;
    settings.lighting = LightingStage::kCompute;
    settings.debug.view = settings::DebugView::kLightSpheres;
    const auto p = planOf(settings, kLit);
    EXPECT_TRUE(p.lights_in_compute && storesRadiance(p) && has(p, kTonemapStep));
    settings.debug.view = settings::DebugView::kNone;
    EXPECT_FALSE(has(planOf(settings, kLit), kTonemapStep));
}

// A second filter reads what the first one packed.
TEST(FramePlan, SeveralFilters_FollowEachOther) {
    settings::ViewSettings settings;
    settings.antialiasing = settings::Antialiasing::kFxaa;
    const std::array rows = {&kIdsStep,  &kDepthStep, &kGbufferStep, &kLightingStep,
                             &kFxaaStep, &kFxaaStep,  &kFxaaStep};
    const FramePlan p = planFrame(settings, kLit, rows);
    ASSERT_GE(p.steps.size(), 4U);
    const auto last = p.steps.end();
    EXPECT_EQ(last[-4].row, &kLightingStep);
    EXPECT_EQ(last[-4].plan.packs, Resource::kDisplay);
    EXPECT_EQ(last[-3].plan.packed, Resource::kDisplay);
    EXPECT_EQ(last[-3].plan.packs, Resource::kDisplay2);
    EXPECT_EQ(last[-2].plan.packed, Resource::kDisplay2);
    EXPECT_EQ(last[-2].plan.packs, Resource::kDisplay);
    EXPECT_EQ(last[-1].plan.packed, Resource::kDisplay);
    EXPECT_EQ(last[-1].plan.packs, Resource::kPixels);
}

TEST(FramePlan, ReusedSurfaces_AreThoseOfStepsThatDrawNothingElse) {
    FrameFacts facts = kLit;
    facts.prepass_pays = true;
    for (const auto geometry :
         {SolidGeometry::kRaster, SolidGeometry::kIds, SolidGeometry::kComputeIds}) {
        facts.geometry = geometry;
        for (const auto renderer : {Renderer::kForwardPlus, Renderer::kClusteredDeferred}) {
            FramePlan p = plan(renderer, facts);
            EXPECT_TRUE(leavesSurfaces(p));
            EXPECT_FALSE(reusesSurfaces(p));
            p.reuse(kSurfaceResources);
            EXPECT_TRUE(reusesSurfaces(p));
            for (const PlannedStep& step : p.steps) {
                const bool draws =
                    step.row == &kIdsStep || step.row == &kDepthStep || step.row == &kGbufferStep;
                EXPECT_EQ(step.reused, draws) << step.row->name;
            }
        }
    }
    facts.geometry = SolidGeometry::kRaster;
    facts.prepass_pays = false;
    EXPECT_FALSE(leavesSurfaces(plan(Renderer::kForwardPlus, facts)));
    facts.overdraw_unknown = true; // what is counted must be drawn
    EXPECT_FALSE(leavesSurfaces(plan(Renderer::kClusteredDeferred, facts)));
}

} // namespace froxel::render

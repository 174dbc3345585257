#include "interface/constants.h"
#include "interface/gbuffer_io.h"
#include "render/frame/plan_words.h"
#include "render/steps/order.h"
#include "render/view/memory_report.h"

#include <gtest/gtest.h>

#include <gmock/gmock.h>

namespace froxel::render {

namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

std::vector<std::string> wordsOf(const settings::ViewSettings& settings, const FrameFacts& facts) {
    return frameWords(settings, facts, planFrame(settings, facts, kOrder), kOrder);
}

scene::Scene sceneOf(uint32_t materials, uint32_t with_normal_maps) {
    scene::Scene scene;
    scene.materials.resize(materials);
    for (uint32_t i = 0; i < with_normal_maps; ++i) {
        scene.materials[i].normal_texture.texture = 0;
    }
    return scene;
}

} // namespace

TEST(PlanWords, NoLights_SayWhatIsSaved) {
    const auto words = wordsOf({}, {});
    EXPECT_THAT(words, Contains("no lights: no assignment, no lists, no light loop"));
    EXPECT_THAT(words, Not(Contains(HasSubstr("cone"))));
    EXPECT_THAT(words, Contains("no transparent surface in view: no sort, no blend pass"));
    EXPECT_THAT(words, Contains("no pass reads linear radiance: no target for it"));
}

TEST(PlanWords, IorAndSpecular_AreNamedWhereTheyAreStored) {
    settings::ViewSettings settings;
    settings.renderer = settings::Renderer::kClusteredDeferred;
    const FrameFacts facts{.lights = io::kLightEdges, .gbuffer = io::kOutputSpecular};
    EXPECT_THAT(wordsOf(settings, facts), Contains(HasSubstr("ior, specular or glossiness")));
    EXPECT_THAT(wordsOf(settings, facts), Contains(HasSubstr("G-buffer of 12 bytes")));
    EXPECT_THAT(wordsOf(settings, facts), Contains(HasSubstr("specular strength below 1")));
    EXPECT_THAT(wordsOf(settings, {}), Not(Contains(HasSubstr("specular strength"))));
    settings.renderer = settings::Renderer::kForwardPlus;
    EXPECT_THAT(wordsOf(settings, facts), Not(Contains(HasSubstr("ior"))));
}

TEST(PlanWords, Layers_AreNamedWhereAPassDrawsThem) {
    settings::ViewSettings settings;
    settings.renderer = settings::Renderer::kClusteredDeferred;
    const FrameFacts facts{.layers_visible = true};
    EXPECT_THAT(wordsOf(settings, facts), Contains(HasSubstr("materials with layers again")));
    EXPECT_THAT(wordsOf(settings, facts), Contains(HasSubstr("tone mapping in a separate pass")));
    EXPECT_THAT(wordsOf(settings, {}), Not(Contains(HasSubstr("layers:"))));
    settings.renderer = settings::Renderer::kForwardPlus;
    EXPECT_THAT(wordsOf(settings, facts), Not(Contains(HasSubstr("layers:"))));
}

TEST(PlanWords, MeshesThatBend_AreNamed) {
    EXPECT_THAT(wordsOf({}, {.bends = true}), Contains(HasSubstr("skins or morph targets")));
    EXPECT_THAT(wordsOf({}, {}), Not(Contains(HasSubstr("skins"))));
}

TEST(PlanWords, LightsOfOneRadius_AreNamed) {
    const auto words = wordsOf({}, {.lights = io::kLightLocal | io::kLightEqualRadii});
    EXPECT_THAT(words, Contains("all radii equal: radius is a constant"));
    EXPECT_THAT(words, Contains("no spot light: no cone data"));
    EXPECT_THAT(words, Contains(HasSubstr("light lists")));
}

TEST(PlanWords, WorkOnTheLitPicture_IsNamedWhereItIs) {
    settings::ViewSettings settings;
    const auto of_post =
        ::testing::AnyOf(HasSubstr("bloom"), HasSubstr("outline"), HasSubstr("fxaa"),
                         HasSubstr("ssaa4"), HasSubstr("fog"), HasSubstr("exposure"));
    EXPECT_THAT(wordsOf(settings, {}), Not(Contains(of_post)));
    settings.renderer = settings::Renderer::kToonCompute;
    settings.toon_outline.strength = 1;
    settings.bloom.kind = settings::BloomKind::kATrous;
    settings.exposure_mode = settings::ExposureMode::kFrame;
    settings.antialiasing = settings::Antialiasing::kSsaa4;
    const auto words = wordsOf(settings, {});
    EXPECT_THAT(words, Contains(HasSubstr("outline")));
    EXPECT_THAT(words, Contains(HasSubstr("bloom by a_trous")));
    EXPECT_THAT(words, Contains(HasSubstr("exposure of this frame")));
    EXPECT_THAT(words, Contains(HasSubstr("ssaa4")));
    EXPECT_THAT(words,
                Contains("tone mapping in a separate pass, after the passes over the lit picture"));
    settings.antialiasing = settings::Antialiasing::kFxaa;
    EXPECT_THAT(wordsOf(settings, {}), Contains(HasSubstr("fxaa")));
}

TEST(PlanWords, Toon_SaysWhatHasBandsAndWhetherThereIsARim) {
    settings::ViewSettings settings;
    const FrameFacts facts{.lights = io::kLightLocal};
    EXPECT_THAT(wordsOf(settings, facts), Not(Contains(HasSubstr("toon"))));
    settings.renderer = settings::Renderer::kToonFragment;
    EXPECT_THAT(wordsOf(settings, facts), Contains("3 toon bands of each light"));
    settings.renderer = settings::Renderer::kToonCompute;
    EXPECT_THAT(wordsOf(settings, facts), Contains("3 toon bands of the lit colour"));
    EXPECT_THAT(wordsOf(settings, facts), Contains(HasSubstr("toon rim")));
    settings.toon = {.bands = 0, .rim = 0};
    EXPECT_THAT(wordsOf(settings, facts), Not(Contains(HasSubstr("toon bands"))));
    EXPECT_THAT(wordsOf(settings, facts), Not(Contains(HasSubstr("toon rim"))));
}

TEST(PlanWords, Transparency_IsNamedWhereSomethingIsBlended) {
    settings::ViewSettings settings;
    settings.transparency = settings::Transparency::kPeeled;
    settings.peel_layers = 5;
    EXPECT_THAT(wordsOf(settings, {}), Not(Contains(HasSubstr("peeled"))));
    EXPECT_THAT(wordsOf(settings, {.transparent_visible = true}),
                Contains(HasSubstr("up to 5 layers peeled")));
    settings.transparency = settings::Transparency::kWeighted;
    EXPECT_THAT(wordsOf(settings, {.transparent_visible = true}),
                Contains(HasSubstr("weighted by distance")));
}

TEST(PlanWords, Fog_SaysWhetherLightsAreScattered) {
    settings::ViewSettings settings;
    settings.fog.density = 0.1F;
    EXPECT_THAT(wordsOf(settings, {}), Contains(HasSubstr("no froxel volume")));
    const auto words = wordsOf(settings, {.lights = io::kLightLocal});
    EXPECT_THAT(words, Contains(HasSubstr("in a froxel volume")));
    EXPECT_THAT(words,
                Contains("tone mapping in a separate pass, after the passes over the lit picture"));
}

TEST(PlanWords, ShadowMaps_AreNamedWhereTheyAreDrawn) {
    settings::ViewSettings settings;
    settings.shadows = {8, 128};
    EXPECT_THAT(wordsOf(settings, {.lights = io::kLightLocal}),
                Not(Contains(HasSubstr("shadow maps"))));
    EXPECT_THAT(wordsOf(settings, {.lights = io::kLightLocal | io::kLightShadows}),
                Contains("shadow maps: up to 8 lights, faces of 128 pixels a side"));
}

TEST(PlanWords, Environment_IsNamed) {
    settings::ViewSettings settings;
    EXPECT_THAT(wordsOf(settings, {}), Not(Contains(HasSubstr("environment"))));
    settings.environment.light = settings::EnvironmentLight::kStudio;
    EXPECT_THAT(wordsOf(settings, {}), Contains("environment: studio, replaces the ambient light"));
    EXPECT_THAT(wordsOf(settings, {}), Not(Contains(HasSubstr("background"))));
    settings.environment.background = true;
    EXPECT_THAT(wordsOf(settings, {}), Contains(HasSubstr("background: a separate pass")));
}

TEST(PlanWords, Scene_CountsMaterials) {
    EXPECT_THAT(sceneWords(findNeeds(sceneOf(25, 18))),
                Contains("normal maps on 18 of 25 materials"));
    EXPECT_THAT(sceneWords(findNeeds(sceneOf(25, 0))),
                Contains("no normal maps: no tangent frames"));
}

TEST(MemoryReport, Largest_ComesFirst) {
    gpu::MemoryLedger ledger;
    ledger.add("indices", 5);
    ledger.add("textures", 50);
    ledger.add("depth", 7);
    const auto report = memoryReport(ledger);
    ASSERT_THAT(report, SizeIs(3));
    EXPECT_EQ(report[0].purpose, "textures");
    EXPECT_EQ(report[2].bytes, 5U);
}

TEST(FrameDetails, OnlyAChange_MakesAnotherObject) {
    gpu::MemoryLedger ledger;
    ledger.add("depth", 7);
    FrameDetailsKeeper keeper;
    const SceneNeeds needs;
    FrameFacts facts;
    const auto update = [&] {
        return keeper.update({}, facts, planFrame({}, facts, kOrder), needs, ledger, nullptr);
    };
    const auto first = update();
    EXPECT_EQ(first, update());
    ledger.add("depth", 1);
    ledger.remove("depth", 1);
    EXPECT_EQ(first, update()); // came and went
    ledger.add("textures", 1);
    const auto second = update();
    EXPECT_NE(first, second);
    EXPECT_EQ(first->plan, second->plan);
    EXPECT_THAT(second->memory, SizeIs(2));
    facts.transparent_visible = true;
    const auto third = update();
    EXPECT_NE(second, third);
    EXPECT_THAT(third->plan, Contains("transparent surfaces in view: sorted and blended"));
}

} // namespace froxel::render

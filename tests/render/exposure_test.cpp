// Exposure that a frame meters by itself: against the same sums in double, and what it promises: a
// function of the frame alone, the same for every way to draw it, defined for every picture.
#include "reference/exposure.h"
#include "render/view/visibility_readback.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/shapes.h"
#include "support/test_scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

namespace froxel::test {

namespace {

using settings::ExposureMode;
using settings::LightingStage;
using settings::Renderer;

class Exposure : public SharedGpuTest {};

// The widest bin: the first eighth of an octave.
const double kBin_ev = std::log2(1.125);

// With a white sign on the left that no light reaches.
scene::Scene roomWithASign() {
    scene::Scene scene = makeRoom();
    scene::Material sign;
    sign.unlit = true;
    scene.materials.push_back(sign);
    const auto material = static_cast<uint32_t>(scene.materials.size() - 1);
    scene.instances.push_back({static_cast<uint32_t>(scene.meshes.size()), glm::dmat4(1), {}});
    scene.meshes.push_back({"sign", {quad({-5, 0.5, -3}, {2.5, 0, 0}, {0, 3, 0}, 1, material)}});
    return scene;
}

render::FrameInputs inputsFor(const settings::Camera& camera, const settings::Size& size) {
    render::FrameInputs inputs;
    inputs.settings.camera = camera;
    inputs.settings.size = size;
    inputs.settings.lights.count = 40;
    inputs.settings.exposure_mode = ExposureMode::kFrame;
    inputs.time_s = 1.5;
    return inputs;
}

// Without what is blended, which does not count.
scene::Scene solidPartOf(scene::Scene scene) {
    for (scene::Mesh& mesh : scene.meshes) {
        std::erase_if(mesh.primitives, [&](const scene::Primitive& primitive) {
            return scene.materials[primitive.material].alpha_mode == scene::AlphaMode::kBlend;
        });
    }
    return scene;
}

// The same picture with the exposure that a frame has metered.
render::FrameInputs fixedAs(render::FrameInputs inputs, const Picture& metered) {
    inputs.settings.exposure_mode = ExposureMode::kFixed;
    inputs.settings.exposure *=
        static_cast<float>(std::exp2(metered.stats.steps.find("", "metered_ev").value()));
    return inputs;
}

LinearImage linearOf(const Picture& picture) {
    return {picture.width_px, picture.height_px, picture.radiance};
}

// By bins of an eighth of each octave, each pixel at its bin's geometric middle.
double
expected_ev(const scene::Scene& scene, const Picture& picture, const Visibility& visibility) {
    std::vector<double> middles_ev;
    for (size_t i = 0; i < visibility.pixels.size(); ++i) {
        const auto& seen = visibility.pixels[i];
        const float* rgb = &picture.radiance[3 * i];
        const double luminance = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
        if (seen.instance == VisibleTriangle::kNothing || !(luminance >= std::exp2(-16))) {
            continue;
        }
        const auto& mesh = scene.meshes[scene.instances[seen.instance].mesh];
        if (scene.materials[mesh.primitives[seen.primitive].material].unlit) {
            continue;
        }
        const double octave = std::min(15.0, std::floor(std::log2(luminance)));
        const double eighth = std::min(7.0, std::floor(8 * (luminance / std::exp2(octave) - 1)));
        middles_ev.push_back(octave + 0.5 * std::log2((1 + eighth / 8) * (1 + (eighth + 1) / 8)));
    }
    if (middles_ev.empty()) {
        return 0;
    }
    std::ranges::sort(middles_ev);
    const auto dropped = static_cast<ptrdiff_t>(middles_ev.size() / 10);
    const double sum =
        std::accumulate(middles_ev.begin() + dropped, middles_ev.end() - dropped, 0.0);
    const auto kept = static_cast<double>(middles_ev.size()) - 2 * static_cast<double>(dropped);
    return std::clamp(std::log2(0.18) - sum / kept, -10.0, 10.0);
}

size_t differingBytes(const Picture& a, const Picture& b) {
    EXPECT_EQ(a.rgba8.size(), b.rgba8.size());
    return std::transform_reduce(a.rgba8.begin(), a.rgba8.end(), b.rgba8.begin(), size_t{0},
                                 std::plus(), std::not_equal_to());
}

// What is shown is what a fixed exposure of that much shows, to the byte.
void expectAsFixed(render::ViewRenderer& view,
                   const render::FrameInputs& inputs,
                   const Picture& metered) {
    const Picture fixed = draw(view, fixedAs(inputs, metered));
    EXPECT_EQ(differingFloats(metered, fixed), 0U);
    EXPECT_EQ(differingBytes(metered, fixed), 0U);
}

// A wall that shines by itself and fills the view.
scene::Scene shiningWall(float emission) {
    SceneMaker maker = wallAhead(3);
    maker.scene.materials[0].emissive = glm::vec3(emission);
    return maker.scene;
}

render::FrameInputs atAWall(Renderer renderer) {
    auto inputs = inputsFor({}, {33, 17});
    inputs.settings.renderer = renderer;
    inputs.settings.lights.count = 0;
    inputs.settings.lights.ambient = 0;
    return inputs;
}

} // namespace

// Sizes with and without whole workgroups; glass, masks and an unlit sign are in the picture. What
// is shown is what a fixed exposure of that much shows, to the byte.
TEST_F(Exposure, EveryRendererAndStage_AgainstDouble_IsWithinRounding) {
    const auto scene = roomWithASign();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    const auto solid_scene = solidPartOf(scene);
    render::Renderer solid_renderer(device(), solid_scene);
    render::ViewRenderer solid_view(solid_renderer);
    const std::array<settings::Size, 3> sizes = {{{96, 64}, {97, 55}, {31, 130}}};
    for (size_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
        for (const auto stage : {LightingStage::kCompute, LightingStage::kFragment}) {
            SCOPED_TRACE(std::string(settings::kRendererNames[kind]) + ", " +
                         std::to_string(static_cast<int>(stage)));
            auto inputs = inputsFor(scene.cameras[0].camera, sizes[kind % sizes.size()]);
            inputs.settings.renderer = static_cast<Renderer>(kind);
            inputs.settings.lighting = stage;
            inputs.settings.exposure = 1.5F;
            inputs.settings.toon_outline.strength = 0.5F;
            const Picture metered = draw(view, inputs);
            const auto seen = render::readVisibility(renderer, scene, inputs);
            ASSERT_TRUE(seen) << seen.error().message;
            ASSERT_TRUE(metered.stats.steps.find("", "metered_ev"));
            const double ev = *metered.stats.steps.find("", "metered_ev");
            const Picture solid = draw(solid_view, inputs);
            // a pixel at the edge of a bin may be rounded into the next
            EXPECT_NEAR(ev, expected_ev(scene, solid, *seen), 1e-3);
            EXPECT_NEAR(ev, std::log2(reference::meteredFactor(scene, linearOf(solid), *seen)),
                        kBin_ev / 2);
            EXPECT_GT(std::abs(ev), 0.2); // it does something
            expectAsFixed(view, inputs, metered);
        }
    }
}

TEST_F(Exposure, ForwardPlus_IsNaives) {
    const auto scene = roomWithASign();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (const auto stage : {LightingStage::kCompute, LightingStage::kFragment}) {
        auto inputs = inputsFor(scene.cameras[1].camera, {97, 55});
        inputs.settings.lighting = stage;
        inputs.settings.renderer = Renderer::kNaive;
        const Picture naive = draw(view, inputs);
        inputs.settings.renderer = Renderer::kForwardPlus;
        inputs.settings.light_loop = settings::LightLoop::kLists;
        const Picture lists = draw(view, inputs);
        EXPECT_EQ(naive.stats.steps.find("", "metered_ev"),
                  lists.stats.steps.find("", "metered_ev"));
        EXPECT_EQ(differingBytes(naive, lists), 0U);
    }
}

TEST_F(Exposure, LightsAThousandTimesAsBright_ShowTheSamePictureWithinABin) {
    auto scene = makeRoom();
    for (auto& material : scene.materials) {
        material.emissive = glm::vec3(0);
    }
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene.cameras[0].camera, {96, 54});
    inputs.settings.lights.intensity = 0.25F;
    inputs.settings.lights.ambient = 0.25F;
    const Picture dim = draw(view, inputs);
    inputs.settings.lights.intensity = 250;
    inputs.settings.lights.ambient = 250;
    const Picture bright = draw(view, inputs);
    EXPECT_NEAR(*bright.stats.steps.find("", "metered_ev"),
                *dim.stats.steps.find("", "metered_ev") - std::log2(1000), kBin_ev);
    // Of what lights shine on: the background and what is unlit are as they were.
    ptrdiff_t lit = 0;
    double difference = 0;
    for (size_t i = 0; i < dim.radiance.size(); ++i) {
        if (std::abs(bright.radiance[i] - 1000 * dim.radiance[i]) < 1e-3F * bright.radiance[i]) {
            const size_t at = i / 3 * 4 + i % 3;
            difference += std::to_integer<int>(bright.rgba8[at]);
            difference -= std::to_integer<int>(dim.rgba8[at]);
            ++lit;
        }
    }
    ASSERT_GT(lit, std::ssize(dim.radiance) / 4);
    EXPECT_NEAR(difference / static_cast<double>(lit), 0, 4);
}

// The sign fills most of the picture; the wall behind it is what counts.
TEST_F(Exposure, UnlitAndEmptyPixels_DoNotCount) {
    scene::Scene scene = shiningWall(0.18F / 4);
    scene::Material sign;
    sign.unlit = true;
    SceneMaker maker;
    maker.scene = scene;
    const uint32_t unlit = maker.add(sign);
    maker.add(quad({-0.5, -2, -2}, {4, 0, 0}, {0, 4, 0}, 1, unlit));
    for (size_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
        if (static_cast<Renderer>(kind) == Renderer::kToonCompute) {
            continue; // which bends what shines by itself, too
        }
        SCOPED_TRACE(settings::kRendererNames[kind]);
        const auto inputs = atAWall(static_cast<Renderer>(kind));
        render::Renderer renderer(device(), maker.scene);
        EXPECT_NEAR(*draw(renderer, inputs).stats.steps.find("", "metered_ev"), 2, kBin_ev / 2);
        auto away = inputs; // so far that little of the wall is in the picture
        away.settings.camera.eye_world = {0, 0, 30};
        EXPECT_NEAR(*draw(renderer, away).stats.steps.find("", "metered_ev"), 2, kBin_ev / 2);
        away.settings.fog.density = 1e-6F; // keeps the marks of unlit surfaces
        EXPECT_NEAR(*draw(renderer, away).stats.steps.find("", "metered_ev"), 2, kBin_ev / 2);
    }
}

// An unlit quad of 0.2 is 124 in sRGB and the background has its colour, with and without a metered
// exposure; one that is blended passes through the tone map and back.
TEST_F(Exposure, UnlitSurfacesAndTheBackground_HaveTheirOwnColours) {
    SceneMaker maker;
    scene::Material sign;
    sign.unlit = true;
    sign.base_color = {0.2F, 0.2F, 0.2F, 1};
    const uint32_t solid = maker.add(sign);
    sign.alpha_mode = scene::AlphaMode::kBlend;
    const uint32_t blended = maker.add(sign);
    scene::Material grey;
    grey.base_color = {0.5F, 0.5F, 0.5F, 1};
    const uint32_t lit = maker.add(grey);
    maker.add(quad({-3, -1, -4}, {1.5F, 0, 0}, {0, 2, 0}, 1, solid));
    maker.add(quad({-1, -1, -4}, {1.5F, 0, 0}, {0, 2, 0}, 1, blended));
    maker.add(quad({1, -1, -4}, {1.5F, 0, 0}, {0, 2, 0}, 1, lit));
    render::Renderer renderer(device(), maker.scene);
    render::ViewRenderer view(renderer);
    constexpr uint32_t kWidth = 64;
    const auto at = [](const Picture& picture, uint32_t x, uint32_t y) {
        return std::to_integer<int>(picture.rgba8[4 * (size_t{y} * kWidth + x)]);
    };
    for (size_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
        if (static_cast<Renderer>(kind) == Renderer::kToonCompute) {
            continue; // which bends what is unlit, too
        }
        SCOPED_TRACE(settings::kRendererNames[kind]);
        int lit_before = -1;
        for (const float exposure : {0.1F, 1.0F, 10.0F, 0.0F}) {
            SCOPED_TRACE(exposure);
            auto inputs = inputsFor({}, {kWidth, 36});
            inputs.settings.renderer = static_cast<Renderer>(kind);
            inputs.settings.lights.count = 0;
            inputs.settings.background.color = glm::vec3(0.05F);
            if (exposure > 0) {
                inputs.settings.exposure_mode = ExposureMode::kFixed;
                inputs.settings.exposure = exposure;
            }
            const Picture picture = draw(view, inputs);
            EXPECT_EQ(at(picture, 9, 18), 124);
            EXPECT_NEAR(at(picture, 27, 18), 124, 1);
            EXPECT_EQ(at(picture, 1, 1), 63);
            EXPECT_NE(at(picture, 48, 18), lit_before) << "what is lit is exposed";
            lit_before = at(picture, 48, 18);
        }
    }
}

TEST_F(Exposure, BackgroundsGradient_IsDarkAtTheBottom) {
    const scene::Scene nothing;
    render::Renderer renderer(device(), nothing);
    for (const auto filter : {settings::Antialiasing::kNone, settings::Antialiasing::kSsaa4}) {
        auto inputs = inputsFor({}, {8, 100});
        inputs.settings.antialiasing = filter;
        inputs.settings.background = {glm::vec3(0.05F, 0.1F, 0.2F), 1};
        const Picture picture = draw(renderer, inputs);
        const auto green = [&](size_t row) {
            return std::to_integer<int>(picture.rgba8[4 * 8 * row + 1]);
        };
        EXPECT_NEAR(green(0), 124, 1); // 0.2
        EXPECT_NEAR(green(50), 89, 1); // 0.1
        EXPECT_LT(green(99), 4);
    }
}

TEST_F(Exposure, PictureWithoutLight_KeepsTheExposureAskedFor) {
    const scene::Scene nothing;
    render::Renderer empty(device(), nothing);
    const scene::Scene black_wall = shiningWall(0);
    render::Renderer black(device(), black_wall);
    for (render::Renderer* renderer : {&empty, &black}) {
        render::ViewRenderer view(*renderer);
        auto inputs = atAWall(Renderer::kForwardPlus);
        inputs.settings.exposure = 3;
        const Picture metered = draw(view, inputs);
        EXPECT_EQ(metered.stats.steps.find("", "metered_ev"), 0.0);
        EXPECT_EQ(differingBytes(metered, draw(view, fixedAs(inputs, metered))), 0U);
    }
}

TEST_F(Exposure, WhatNoExposureBringsToGrey_GetsTenStops) {
    const std::pair<float, double> cases[] = {
        {65'504.0F, -10}, {1e30F, -10}, {1e-4F, 10}, {1e-6F, 0}};
    for (const auto& [emission, ev] : cases) {
        SCOPED_TRACE(emission);
        const auto scene = shiningWall(emission);
        render::Renderer renderer(device(), scene);
        const Picture picture = draw(renderer, atAWall(Renderer::kNaive));
        EXPECT_NEAR(picture.stats.steps.find("", "metered_ev").value(), ev, 1e-5);
    }
}

// What a view drew before has no say.
TEST_F(Exposure, Frame_DependsOnNoFrameBefore) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    auto dark = inputsFor(scene.cameras[0].camera, {97, 55});
    dark.settings.lights.intensity = 0.01F;
    auto bright = dark;
    bright.settings.lights.intensity = 100;
    const Picture alone = draw(renderer, dark);
    render::ViewRenderer view(renderer);
    for (int round = 0; round < 3; ++round) {
        EXPECT_NE(draw(view, bright).stats.steps.find("", "metered_ev"),
                  alone.stats.steps.find("", "metered_ev"));
        const Picture after = draw(view, dark);
        EXPECT_EQ(after.stats.steps.find("", "metered_ev"),
                  alone.stats.steps.find("", "metered_ev"));
        EXPECT_EQ(differingBytes(after, alone), 0U);
    }
}

// Bloom's threshold and the lines of debug views follow the exposure; fog, filters and samples are
// there as with a fixed one.
TEST_F(Exposure, WhateverElseIsDrawn_IsAsWithAFixedExposure) {
    using Change = void (*)(settings::ViewSettings&);
    const std::pair<const char*, Change> cases[] = {
        {"fog", [](auto& s) { s.fog.density = 0.1F; }},
        {"fxaa", [](auto& s) { s.antialiasing = settings::Antialiasing::kFxaa; }},
        {"ssaa4", [](auto& s) { s.antialiasing = settings::Antialiasing::kSsaa4; }},
        {"clamp", [](auto& s) { s.tone_map = settings::ToneMap::kClamp; }},
        {"weighted", [](auto& s) { s.transparency = settings::Transparency::kWeighted; }},
        {"peeled", [](auto& s) { s.transparency = settings::Transparency::kPeeled; }},
        {"lines", [](auto& s) { s.debug.view = settings::DebugView::kLightSpheres; }}};
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (const auto& [name, change] : cases) {
        SCOPED_TRACE(name);
        auto inputs = inputsFor(scene.cameras[0].camera, {97, 55});
        change(inputs.settings);
        const Picture metered = draw(view, inputs);
        expectAsFixed(view, inputs, metered);
    }
}

TEST_F(Exposure, BloomsThreshold_IsInMeteredRadiance) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (size_t kind = 1; kind < settings::kBloomKindNames.size(); ++kind) {
        SCOPED_TRACE(settings::kBloomKindNames[kind]);
        auto inputs = inputsFor(scene.cameras[0].camera, {81, 45});
        inputs.settings.bloom = {static_cast<settings::BloomKind>(kind), 0.6F, 0.5F, 0.7F, 0.03F};
        const Picture metered = draw(view, inputs);
        const Picture fixed = draw(view, fixedAs(inputs, metered));
        const float brightest = *std::ranges::max_element(fixed.radiance);
        ASSERT_EQ(metered.radiance.size(), fixed.radiance.size());
        for (size_t i = 0; i < fixed.radiance.size(); ++i) {
            ASSERT_NEAR(metered.radiance[i], fixed.radiance[i], 1e-5 * brightest) << i;
        }
        inputs.settings.exposure_mode = ExposureMode::kFixed;
        EXPECT_GT(differingFloats(draw(view, inputs), fixed), fixed.radiance.size() / 10);
    }
}

TEST_F(Exposure, DebugViewInThePicturesPlace_IsAsWithAFixedExposure) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene.cameras[0].camera, {64, 36});
    inputs.settings.debug.view = settings::DebugView::kBaseColor;
    const Picture metered = drawPixels(view, inputs);
    EXPECT_FALSE(metered.stats.steps.find("", "metered_ev"));
    inputs.settings.exposure_mode = ExposureMode::kFixed;
    EXPECT_EQ(differingBytes(metered, drawPixels(view, inputs)), 0U);
}

TEST_F(Exposure, Fixed_HasNoPassAndNoHistogram) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene.cameras[0].camera, {64, 36});
    inputs.settings.exposure_mode = ExposureMode::kFixed;
    const auto histograms = [] {
        return device().memoryLedger()->byPurpose().contains("exposure histogram");
    };
    const Picture before = draw(view, inputs);
    EXPECT_FALSE(hasPass(before, "exposure"));
    EXPECT_FALSE(before.stats.steps.find("", "metered_ev"));
    EXPECT_FALSE(histograms());
    inputs.settings.exposure_mode = ExposureMode::kFrame;
    EXPECT_TRUE(hasPass(draw(view, inputs), "exposure"));
    EXPECT_TRUE(histograms());
    inputs.settings.exposure_mode = ExposureMode::kFixed;
    const Picture after = draw(view, inputs);
    EXPECT_FALSE(hasPass(after, "exposure"));
    EXPECT_FALSE(after.stats.steps.find("", "metered_ev"));
    EXPECT_FALSE(histograms());
    EXPECT_EQ(differingFloats(before, after), 0U);
    EXPECT_EQ(differingBytes(before, after), 0U);
}

} // namespace froxel::test

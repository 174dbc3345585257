// Blended surfaces in one plane, more of them than are peeled, as many as there are layers.
#include "support/exact.h"
#include "support/gpu_fixture.h"
#include "support/shapes.h"

#include <cmath>
#include <optional>

namespace froxel::test {

namespace {

using settings::Transparency;

class HardTransparency : public SharedGpuTest {};

constexpr int kPanes = 5;

// Unlit, so that its colour is known.
scene::Material tint(int pane) {
    const float part = static_cast<float>(pane) / kPanes;
    scene::Material material = chalk();
    material.base_color = {part, 1 - part, 0.5F, 0.5F};
    material.alpha_mode = scene::AlphaMode::kBlend;
    material.double_sided = true;
    material.unlit = true;
    return material;
}

// A black wall behind panes that are one and the same quad, 2 m ahead.
scene::Scene panesInOnePlane(int panes) {
    scene::Material black = chalk();
    black.base_color = {0, 0, 0, 1};
    SceneMaker maker(black);
    maker.add(quad({-9, -9, -4}, {18, 0, 0}, {0, 18, 0}, 1, 0));
    for (int pane = 0; pane < panes; ++pane) {
        maker.add(quad({-0.9F, -0.6F, -2}, {1.8F, 0, 0}, {0, 1.2F, 0}, 1, maker.add(tint(pane))));
    }
    return maker.scene;
}

// The last `layers` of the panes, the last one in front.
glm::dvec3 composed(int panes, int layers) {
    glm::dvec3 color(0);
    for (int pane = panes - layers; pane < panes; ++pane) {
        color = glm::mix(color, glm::dvec3(glm::vec3(tint(pane).base_color)), 0.5);
    }
    return color;
}

render::FrameInputs inputsFor(Transparency transparency) {
    auto inputs = hardInputs();
    inputs.settings.transparency = transparency;
    inputs.settings.tone_map =
        settings::ToneMap::kClamp; // unlit panes send their colours as they are
    return inputs;
}

render::FrameInputs peeled(uint32_t layers) {
    auto inputs = inputsFor(Transparency::kPeeled);
    inputs.settings.peel_layers = layers;
    return inputs;
}

} // namespace

// Case 32. Two panes of one plane, both seen: of equal depths the one that comes last in the scene
// is in front, from wherever it is seen.
TEST_F(HardTransparency, TwoPanesInOnePlane_AreTwoLayersInTheScenesOrder) {
    const auto scene = panesInOnePlane(2);
    render::Renderer renderer(device(), scene);
    for (const double side_m : {0.0, -0.4, 0.7}) {
        SCOPED_TRACE(side_m);
        auto inputs = peeled(4);
        inputs.settings.camera.eye_world.x = side_m;
        const auto pictures = expectExact(renderer, inputs);
        for (const Picture* picture : {&pictures.naive, &pictures.deferred}) {
            const auto x = static_cast<uint32_t>(32 - 15 * side_m);
            EXPECT_LT(glm::length(colorAt(*picture, x, 18) - composed(2, 2)), 1e-6);
            EXPECT_EQ(picture->stats.steps.count("peel", "layers"), 4U);
            EXPECT_EQ(picture->stats.steps.count("peel", "overflow_pixels"), 0U);
        }
    }
}

// Case 32. Five in one plane and four layers: the last is left out and counted at each pixel of
// the panes, and all else is as with five.
TEST_F(HardTransparency, FivePanesInOnePlane_FourLayers_AreDeterministicAndCounted) {
    const auto scene = panesInOnePlane(kPanes);
    render::Renderer renderer(device(), scene);
    const auto four = expectExact(renderer, peeled(4)).naive;
    const auto five = draw(renderer, peeled(5));
    size_t covered = 0;
    for (uint32_t y = 0; y < four.height_px; ++y) {
        for (uint32_t x = 0; x < four.width_px; ++x) {
            const bool pane = at(five, x, y, 2) > 0;
            covered += pane ? 1U : 0U;
            const glm::dvec3 none(0);
            ASSERT_LT(glm::length(colorAt(four, x, y) - (pane ? composed(kPanes, 4) : none)), 1e-6);
            ASSERT_LT(glm::length(colorAt(five, x, y) - (pane ? composed(kPanes, 5) : none)), 1e-6);
        }
    }
    EXPECT_GT(covered, 500U);
    EXPECT_EQ(four.stats.steps.count("peel", "layers"), 4U);
    EXPECT_EQ(four.stats.steps.count("peel", "overflow_pixels"), covered);
    EXPECT_EQ(five.stats.steps.count("peel", "overflow_pixels"), 0U);
    render::Renderer again(device(), scene);
    EXPECT_EQ(differingFloats(four, draw(again, peeled(4))), 0U);
}

// Every number of layers below that of the panes is counted, also where a pixel has four samples.
TEST_F(HardTransparency, LayersBeyondTheLast_AreCountedPixelByPixel) {
    const auto scene = panesInOnePlane(kPanes);
    render::Renderer renderer(device(), scene);
    std::optional<uint64_t> covered;
    for (uint32_t layers = 1; layers <= 16; ++layers) {
        const auto count =
            draw(renderer, peeled(layers)).stats.steps.count("peel", "overflow_pixels");
        covered = covered.value_or(count);
        EXPECT_EQ(count, layers < kPanes ? *covered : 0U) << layers;
    }
    auto inputs = peeled(4);
    inputs.settings.antialiasing = settings::Antialiasing::kSsaa4;
    const auto samples = draw(renderer, inputs).stats.steps.count("peel", "overflow_pixels");
    EXPECT_NEAR(static_cast<double>(samples), 4.0 * static_cast<double>(*covered),
                0.1 * 4.0 * static_cast<double>(*covered));
}

// Weights do not tell them apart: the panes' colours are averaged, whatever their order, and their
// alphas multiplied.
TEST_F(HardTransparency, PanesInOnePlane_Weighted_AreAveraged) {
    const auto scene = panesInOnePlane(kPanes);
    render::Renderer renderer(device(), scene);
    const auto inputs = inputsFor(Transparency::kWeighted);
    const auto picture = expectExact(renderer, inputs).naive;
    glm::dvec3 mean(0);
    for (int pane = 0; pane < kPanes; ++pane) {
        mean += glm::dvec3(glm::vec3(tint(pane).base_color)) / double{kPanes};
    }
    EXPECT_LT(glm::length(colorAt(picture, 32, 18) - mean * (1 - std::pow(0.5, kPanes))), 1e-6);
    EXPECT_EQ(picture.stats.steps.count("peel", "layers"), 0U);
}

} // namespace froxel::test

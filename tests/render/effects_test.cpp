// Antialiasing against many samples a pixel, and outlines: where they are and where they are not.
#include "render/view/sample_mean.h"
#include "settings/samples.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/shapes.h"
#include "support/test_scenes.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace froxel::test {

namespace {

using settings::Antialiasing;
using settings::Renderer;

class Effects : public SharedGpuTest {};

constexpr settings::Size kSize{96, 54};

render::FrameInputs inputsFor(const settings::Camera& camera, Renderer renderer) {
    render::FrameInputs inputs;
    inputs.settings.camera = camera;
    inputs.settings.size = kSize;
    inputs.settings.renderer = renderer;
    inputs.settings.lights.count = 30;
    inputs.time_s = 1.5;
    return inputs;
}

double emitted(std::byte byte) {
    const double c = std::to_integer<int>(byte) / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

std::vector<double> emitted(const Picture& picture) {
    std::vector<double> values;
    for (size_t i = 0; i < picture.rgba8.size(); ++i) {
        if (i % 4 != 3) {
            values.push_back(emitted(picture.rgba8[i]));
        }
    }
    return values;
}

// The mean of 64 pictures, each seen through a lens shifted by another part of a pixel.
std::vector<double> manySamples(render::ViewRenderer& view, const render::FrameInputs& inputs) {
    std::vector<double> mean;
    for (int i = 0; i < 64; ++i) {
        auto shifted = inputs;
        shifted.settings.camera.lens_shift +=
            glm::dvec2((i % 8 - 3.5) / 4 / kSize.width_px, (i / 8 - 3.5) / 4 / kSize.height_px);
        const auto values = emitted(draw(view, shifted));
        mean.resize(values.size());
        for (size_t k = 0; k < values.size(); ++k) {
            mean[k] += values[k] / 64;
        }
    }
    return mean;
}

// As a view that rests is shown.
Picture meanOfSamples(render::ViewRenderer& view, render::FrameInputs inputs) {
    const settings::Camera camera = inputs.settings.camera;
    inputs.settings.antialiasing = Antialiasing::kNone;
    Picture last;
    render::SampleMean mean;
    for (uint32_t i = 0; i < settings::kMeanSamples; ++i) {
        inputs.settings.camera = settings::sampled(camera, kSize, i);
        last = draw(view, inputs);
        mean.add({last.rgba8.data(), kSize.width_px, kSize.height_px, size_t{4} * kSize.width_px});
    }
    last.rgba8 = mean.take();
    return last;
}

double rmse(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    }
    return std::sqrt(sum / static_cast<double>(a.size()));
}

size_t differingPixels(const Picture& a, const Picture& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.rgba8.size(); i += 4) {
        count += std::equal(&a.rgba8[i], &a.rgba8[i] + 4, &b.rgba8[i]) ? 0U : 1U;
    }
    return count;
}

} // namespace

// Nothing but edges: flat colours, at many angles.
TEST_F(Effects, Antialiasing_AgainstManySamples_IsNearer) {
    SceneMaker maker;
    for (int i = 0; i < 12; ++i) {
        scene::Material paint;
        paint.unlit = true;
        paint.base_color = {0.1F + 0.07F * static_cast<float>(i * 5 % 12),
                            0.1F + 0.07F * static_cast<float>(i * 7 % 12), 0.4F, 1};
        glm::dmat4 placed = glm::rotate(glm::dmat4(1), 0.3 + 0.41 * i, glm::dvec3(0, 0, 1));
        placed[3] = glm::dvec4(1.4 * (i % 4) - 2.1, 1.2 * (i / 4) - 1.2, -5 + 0.05 * i, 1);
        maker.add(quad({-0.8F, -0.35F, 0}, {1.6F, 0, 0}, {0, 0.7F, 0}, 1, maker.add(paint)),
                  placed);
    }
    const auto camera = settings::lookAt({0, 0, 0}, {0, 0, -1}, {0, 1, 0});
    render::Renderer renderer(device(), maker.scene);
    render::ViewRenderer view(renderer);
    for (const auto kind : {Renderer::kForwardPlus, Renderer::kClusteredDeferred}) {
        SCOPED_TRACE(settings::kRendererNames[static_cast<size_t>(kind)]);
        auto inputs = inputsFor(camera, kind);
        const auto reference = manySamples(view, inputs);
        const double none = rmse(emitted(draw(view, inputs)), reference);
        inputs.settings.antialiasing = Antialiasing::kFxaa;
        const double fxaa = rmse(emitted(draw(view, inputs)), reference);
        inputs.settings.antialiasing = Antialiasing::kSsaa4;
        const double ssaa4 = rmse(emitted(draw(view, inputs)), reference);
        const double mean16 = rmse(emitted(meanOfSamples(view, inputs)), reference);
        EXPECT_LT(fxaa, 0.75 * none);
        EXPECT_LT(ssaa4, 0.6 * none);
        EXPECT_LT(mean16, 0.2 * none);
        EXPECT_LT(mean16, 0.5 * ssaa4);
    }
}

// By the clamp, whose sums the host can do: samples are tone mapped, then averaged.
TEST_F(Effects, FourSamples_AreToneMappedOneByOne) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene.cameras[0].camera, Renderer::kClusteredDeferred);
    inputs.settings.tone_map = settings::ToneMap::kClamp;
    inputs.settings.background.color = glm::vec3(0); // it is no part of radiance
    inputs.settings.antialiasing = Antialiasing::kSsaa4;
    const Picture resolved = draw(view, inputs);
    ASSERT_EQ(resolved.width_px, kSize.width_px);
    ASSERT_EQ(resolved.radiance.size(), size_t{kSize.width_px} * kSize.height_px * 3);
    inputs.settings.antialiasing = Antialiasing::kNone;
    inputs.settings.size = {2 * kSize.width_px, 2 * kSize.height_px};
    const Picture samples = draw(view, inputs);
    double worst_linear = 0;
    double worst_shown = 0;
    for (uint32_t i = 0; i < resolved.radiance.size(); ++i) {
        const uint32_t x = i / 3 % kSize.width_px;
        const uint32_t y = i / 3 / kSize.width_px;
        double linear = 0;
        double shown = 0;
        for (uint32_t s = 0; s < 4; ++s) {
            const size_t at = size_t{2 * y + s / 2} * samples.width_px + 2 * x + s % 2;
            const auto value = static_cast<double>(samples.radiance[3 * at + i % 3]);
            linear += value / 4;
            shown += std::clamp(value, 0.0, 1.0) / 4;
        }
        worst_linear =
            std::max(worst_linear, std::abs(linear - static_cast<double>(resolved.radiance[i])) /
                                       (linear + 1e-3));
        const double srgb =
            shown <= 0.0031308 ? 12.92 * shown : 1.055 * std::pow(shown, 1 / 2.4) - 0.055;
        const double byte = std::to_integer<int>(resolved.rgba8[i / 3 * 4 + i % 3]);
        worst_shown = std::max(worst_shown, std::abs(byte - 255 * srgb));
    }
    EXPECT_LT(worst_linear, 1e-6);
    EXPECT_LT(worst_shown, 0.6); // rounded to the nearest byte
}

TEST_F(Effects, FourSamples_AreCountedAsFour) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene.cameras[0].camera, Renderer::kNaive);
    inputs.settings.count_pairs = true;
    const auto evaluated = [&] {
        return draw(view, inputs).stats.steps.count("pairs", "evaluated");
    };
    const uint64_t one = evaluated();
    inputs.settings.antialiasing = Antialiasing::kSsaa4;
    const uint64_t four = evaluated();
    EXPECT_EQ(four % 30, 0U);
    EXPECT_NEAR(static_cast<double>(four) / static_cast<double>(one), 4, 0.1);
}

TEST_F(Effects, Everything_InEveryRenderer_IsDrawn) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (size_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
        SCOPED_TRACE(settings::kRendererNames[kind]);
        auto inputs = inputsFor(scene.cameras[0].camera, static_cast<Renderer>(kind));
        const Picture plain = draw(view, inputs);
        inputs.settings.toon_outline.strength = 1;
        inputs.settings.bloom = {settings::BloomKind::kMipChain, 0.5F, 0.5F, 0.5F, 0.03F};
        for (const auto antialiasing : {Antialiasing::kFxaa, Antialiasing::kSsaa4}) {
            inputs.settings.antialiasing = antialiasing;
            const Picture picture = draw(view, inputs);
            EXPECT_EQ(picture.rgba8.size(), plain.rgba8.size());
            EXPECT_GT(differingPixels(picture, plain), plain.rgba8.size() / 4 / 10);
        }
        inputs.settings = inputsFor(scene.cameras[0].camera, static_cast<Renderer>(kind)).settings;
        const Picture again = draw(view, inputs);
        EXPECT_EQ(again.rgba8, plain.rgba8);
        EXPECT_FALSE(device().memoryLedger()->byPurpose().contains("display"));
    }
}

TEST_F(Effects, Fxaa_WhereNothingChanges_ChangesNothing) {
    const scene::Scene nothing;
    render::Renderer renderer(device(), nothing);
    auto inputs = inputsFor({}, Renderer::kForwardPlus);
    const Picture before = draw(renderer, inputs);
    inputs.settings.antialiasing = Antialiasing::kFxaa;
    EXPECT_EQ(draw(renderer, inputs).rgba8, before.rgba8);
}

// Depth is affine over a plane, so that even one seen along its surface has no edge; nor has a
// scene by a renderer that is no toon one.
TEST_F(Effects, Outline_OfAPlaneAtAnyAngle_IsNone) {
    SceneMaker maker;
    maker.add(quad({-400, -1, 10}, {800, 0, 0}, {0, 0.9F, -800}, 1, 0));
    maker.point({0, 0, -3}, 0, 3);
    render::Renderer renderer(device(), maker.scene);
    const auto down = settings::lookAt({0, 0, 0}, {0, -0.5, -1}, {0, 1, 0});
    for (const auto kind : {Renderer::kToonFragment, Renderer::kToonCompute}) {
        auto inputs = inputsFor(down, kind);
        const Picture before = draw(renderer, inputs);
        inputs.settings.toon_outline = {1, 0.01F};
        EXPECT_EQ(differingFloats(before, draw(renderer, inputs)), 0U);
    }
}

namespace {

scene::Scene squareBeforeAWall() {
    auto maker = wallAhead(8);
    glm::dmat4 placed(1);
    placed[3] = glm::dvec4(0, 0, -4, 1);
    maker.add(quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 1, 0), placed);
    maker.point({0, 1, -1}, 0, 20);
    return maker.scene;
}

} // namespace

// A square before a wall: lines run along its silhouette, inside it, and nowhere else.
TEST_F(Effects, Outline_RunsAlongEdgesAlone) {
    const auto scene = squareBeforeAWall();
    render::Renderer renderer(device(), scene);
    for (const auto kind : {Renderer::kToonFragment, Renderer::kToonCompute}) {
        auto inputs = inputsFor({}, kind);
        inputs.settings.camera.yfov_rad = glm::radians(60.0);
        inputs.settings.lights.count = 0;
        const Picture before = draw(renderer, inputs);
        inputs.settings.toon_outline = {1, 0.003F};
        const Picture after = draw(renderer, inputs);
        // The square's sides are 1 / (4 tan 30) of half the height: 2 x 11.7 pixels.
        const double half = 27 / (4 * std::tan(glm::radians(30.0)));
        size_t dark = 0;
        for (uint32_t y = 0; y < kSize.height_px; ++y) {
            for (uint32_t x = 0; x < kSize.width_px; ++x) {
                const double off = std::max(std::abs(x + 0.5 - 48), std::abs(y + 0.5 - 27)) - half;
                const size_t at = 3 * (size_t{y} * kSize.width_px + x);
                const bool darkened = after.radiance[at] != before.radiance[at];
                dark += darkened ? 1U : 0U;
                EXPECT_TRUE(!darkened || (off > -1.5 && off < 0)) << x << " " << y;
                EXPECT_TRUE(darkened || off < -0.6 || off > 0) << x << " " << y;
                EXPECT_TRUE(!darkened || after.radiance[at] == 0.0F);
            }
        }
        EXPECT_GT(dark, 80U);
        inputs.settings.renderer = Renderer::kClusteredDeferred;
        const Picture deferred = draw(renderer, inputs);
        inputs.settings.toon_outline = {};
        EXPECT_EQ(differingFloats(deferred, draw(renderer, inputs)), 0U);
    }
}

// 1.35 pixels: the farther one is darkened by what is left of it.
TEST_F(Effects, Outline_BetweenTwoPixels_DarkensTheFartherInPart) {
    const auto scene = squareBeforeAWall();
    render::Renderer renderer(device(), scene);
    auto inputs = inputsFor({}, Renderer::kToonFragment);
    inputs.settings.size = {240, 135};
    inputs.settings.lights.count = 0;
    const Picture before = draw(renderer, inputs);
    inputs.settings.toon_outline = {1, 0.01F};
    const Picture after = draw(renderer, inputs);
    size_t black = 0;
    size_t in_part = 0;
    for (size_t i = 0; i < before.radiance.size(); i += 3) {
        const float left = after.radiance[i] / before.radiance[i];
        black += left == 0 ? 1U : 0U;
        in_part += std::abs(left - 0.65F) < 1e-4F ? 1U : 0U;
        EXPECT_TRUE(left == 0 || left == 1 || std::abs(left - 0.65F) < 1e-4F) << left;
    }
    EXPECT_GT(black, 100U);
    EXPECT_GT(in_part, 100U);
}

} // namespace froxel::test

#include "support/exact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace froxel::test {

using settings::Renderer;

namespace {

// A deferred renderer by lists, checked against all lights.
Picture listsAndAll(render::ViewRenderer& view, render::FrameInputs inputs, Renderer kind) {
    SCOPED_TRACE(settings::kRendererNames[static_cast<size_t>(kind)]);
    inputs.settings.renderer = kind;
    inputs.settings.light_loop = settings::LightLoop::kLists;
    Picture lists = draw(view, inputs);
    inputs.settings.light_loop = settings::LightLoop::kAllLights;
    EXPECT_EQ(differingFloats(lists, draw(view, inputs)), 0U);
    EXPECT_EQ(nonFinite(lists), 0U);
    return lists;
}

} // namespace

render::FrameInputs hardInputs() {
    render::FrameInputs inputs;
    auto& settings = inputs.settings;
    settings.camera.yfov_rad = glm::radians(60.0);
    settings.size = {64, 36};
    settings.shading = settings::ShadingModel::kLambert;
    settings.light_loop = settings::LightLoop::kLists;
    settings.grid = {.automatic = false, .size = {16, 9, 24}, .law = {}};
    settings.lights.count = 0;
    settings.lights.ambient = 0;
    return inputs;
}

Picture drawByPlanes(render::Renderer& renderer, render::FrameInputs inputs) {
    inputs.settings.renderer = Renderer::kNaive;
    inputs.settings.lighting = settings::LightingStage::kCompute;
    inputs.geometry = render::GeometryPath::kComputeRaster;
    return draw(renderer, inputs);
}

ExactPictures expectExact(render::ViewRenderer& view, render::FrameInputs inputs, Toon toon) {
    ExactPictures pictures;
    inputs.settings.renderer = Renderer::kNaive;
    pictures.naive = draw(view, inputs);
    EXPECT_EQ(nonFinite(pictures.naive), 0U);
    inputs.settings.renderer = Renderer::kForwardPlus;
    inputs.settings.light_loop = settings::LightLoop::kLists;
    inputs.depth_prepass = true; // which small scenes would not be given
    pictures.forward_plus = draw(view, inputs);
    inputs.depth_prepass.reset();
    EXPECT_EQ(differingFloats(pictures.naive, pictures.forward_plus), 0U);
    pictures.deferred = listsAndAll(view, inputs, Renderer::kClusteredDeferred);
    if (toon == Toon::kToo) {
        (void)listsAndAll(view, inputs, Renderer::kToonFragment);
        (void)listsAndAll(view, inputs, Renderer::kToonCompute);
    }
    return pictures;
}

ExactPictures
expectExact(render::Renderer& renderer, const render::FrameInputs& inputs, Toon toon) {
    render::ViewRenderer view(renderer);
    return expectExact(view, inputs, toon);
}

size_t nonFinite(const Picture& picture) {
    return static_cast<size_t>(std::count_if(picture.radiance.begin(), picture.radiance.end(),
                                             [](float v) { return !std::isfinite(v); }));
}

size_t litPixels(const Picture& picture, float least) {
    size_t count = 0;
    for (size_t i = 0; i + 2 < picture.radiance.size(); i += 3) {
        const auto* p = &picture.radiance[i];
        count += std::max({p[0], p[1], p[2]}) > least ? 1U : 0U;
    }
    return count;
}

float largest(const Picture& picture) {
    return picture.radiance.empty()
               ? 0.0F
               : *std::max_element(picture.radiance.begin(), picture.radiance.end());
}

float at(const Picture& picture, uint32_t x, uint32_t y, uint32_t channel) {
    return picture.radiance.at(3 * (size_t{y} * picture.width_px + x) + channel);
}

} // namespace froxel::test

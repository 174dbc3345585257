// What the tests of fog draw, and how far a picture is from another.
#pragma once

#include "reference/shade.h"
#include "render/view/visibility_readback.h"
#include "support/draw.h"
#include "support/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace froxel::test {

inline constexpr settings::Size kSize{160, 90};

inline render::FrameInputs inputsFor(const settings::Camera& camera, uint32_t lights) {
    render::FrameInputs inputs;
    inputs.settings.camera = camera;
    inputs.settings.size = kSize;
    inputs.settings.lights.count = lights;
    inputs.settings.light_loop = settings::LightLoop::kLists;
    inputs.time_s = 1.5;
    return inputs;
}

inline settings::Camera ahead() {
    return settings::lookAt({0, 0, 0}, {0, 0, -1}, {0, 1, 0});
}

inline std::vector<std::string> passesOf(const Picture& picture) {
    std::vector<std::string> names;
    for (const auto& pass : picture.stats.passes) {
        names.emplace_back(pass.name);
    }
    return names;
}

inline LinearImage
meant(render::Renderer& renderer, const scene::Scene& scene, const render::FrameInputs& inputs) {
    const auto seen = render::readVisibility(
        renderer, scene, {.settings = inputs.settings, .time_s = inputs.time_s});
    EXPECT_TRUE(seen);
    auto picture = reference::shade(scene, inputs.settings, inputs.time_s, *seen);
    EXPECT_TRUE(picture);
    return std::move(*picture);
}

// What is off of a picture's light, as a share of it. Not its square: a ray that meets a lamp has a
// peak of its own, as narrow as a ray.
inline double errorOf(const std::vector<float>& drawn, const std::vector<float>& right) {
    EXPECT_EQ(drawn.size(), right.size());
    double off = 0;
    double sum = 0;
    for (size_t i = 0; i < drawn.size(); ++i) {
        off += std::abs(static_cast<double>(drawn[i]) - static_cast<double>(right[i]));
        sum += static_cast<double>(right[i]);
    }
    return off / sum;
}

inline double errorOf(render::Renderer& renderer,
                      const LinearImage& reference,
                      const render::FrameInputs& inputs) {
    return errorOf(draw(renderer, inputs).radiance, reference.rgb);
}

// Lamps in an empty box: what is seen is their light in the air.
inline SceneMaker lampsInTheAir() {
    auto maker = insideOfABox(8);
    maker.point({-1.5, 0.5, -4}, 3, 2).point({1, -1, -6}, 0, 1).point({2, 1, -3}, 2, 4);
    maker.spot({-3, 3, -5}, {0.5, -1, 0}, 7, 10, 25);
    return maker;
}

} // namespace froxel::test

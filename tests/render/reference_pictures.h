// What the tests against the double-precision reference draw, and how far a picture is from it.
#pragma once

#include "reference/shade.h"
#include "render/view/visibility_readback.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/test_scenes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace froxel::test {

inline render::FrameInputs inputsFor(const settings::Camera& camera, settings::Renderer renderer) {
    render::FrameInputs inputs;
    inputs.settings.camera = camera;
    inputs.settings.size = {160, 90};
    inputs.settings.renderer = renderer;
    inputs.settings.lights.count = 60;
    inputs.time_s = 3.25;
    return inputs;
}

// A step between bands is as large as a band, however small the error that crosses it.
inline render::FrameInputs withoutBands(render::FrameInputs inputs) {
    inputs.settings.toon = {.bands = 0, .rim = 0};
    return inputs;
}

// The largest relative error that fp32 may leave; of_lavapipe: whose operations round to nearest. A
// GPU's quotients, roots and powers are off by up to 3 units of the last place, and its rasteriser
// interpolates depths less exactly than a plane is met. Measured on an H200, doubled: 1.8e-4 where
// triangles are met in compute, 1.5e-3 where they come from the rasteriser.
inline double arithmeticBound(double of_lavapipe, settings::LightingStage stage) {
    const bool rastered = stage == settings::LightingStage::kFragment;
    return !onGpu() ? of_lavapipe : rastered ? 3e-3 : 4e-4;
}

// Errors of a linear picture, channel by channel. relative: over the reference's value and a
// hundredth of radiance.
struct Errors {
    double max = 0;
    double p999 = 0;
    double median = 0;
    double rmse = 0;
    double max_relative = 0;
};

inline double percentile(std::vector<double>& values, double share) {
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<size_t>(at)];
}

inline Errors errorsOf(const Picture& picture, const LinearImage& expected) {
    EXPECT_EQ(picture.radiance.size(), expected.rgb.size());
    Errors errors;
    std::vector<double> all;
    double squares = 0;
    for (size_t i = 0; i < std::min(picture.radiance.size(), expected.rgb.size()); ++i) {
        const double value = static_cast<double>(expected.rgb[i]);
        const double error = std::abs(static_cast<double>(picture.radiance[i]) - value);
        EXPECT_TRUE(std::isfinite(error));
        all.push_back(error);
        squares += error * error;
        errors.max_relative = std::max(errors.max_relative, error / (value + 0.01));
    }
    errors.max = percentile(all, 1);
    errors.p999 = percentile(all, 0.999);
    errors.median = percentile(all, 0.5);
    errors.rmse = std::sqrt(squares / static_cast<double>(all.size()));
    return errors;
}

class Compared {
  public:
    Compared(gpu::Device& device, const scene::Scene& scene)
        : scene_(scene), renderer_(device, scene) {}

    Errors against(const render::FrameInputs& inputs) {
        const auto seen = render::readVisibility(renderer_, scene_, inputs);
        const Picture picture = draw(renderer_, inputs);
        if (!seen) {
            ADD_FAILURE() << seen.error().message;
            return {};
        }
        const auto expected = reference::shade(scene_, inputs.settings, inputs.time_s, *seen);
        if (!expected) {
            ADD_FAILURE() << expected.error().message;
            return {};
        }
        const Errors errors = errorsOf(picture, *expected);
        ::testing::Test::RecordProperty("rmse", std::to_string(errors.rmse));
        std::printf("R2 max %.3g p99.9 %.3g median %.3g RMSE %.3g relative %.3g\n", errors.max,
                    errors.p999, errors.median, errors.rmse, errors.max_relative);
        return errors;
    }

  private:
    const scene::Scene& scene_;
    render::Renderer renderer_;
};

// The room without textures, without its coplanar panes; a spot and a sun.
inline scene::Scene makePlainRoom() {
    scene::Scene room = makeRoom();
    for (auto& material : room.materials) {
        material.base_color_texture = {};
        material.normal_texture = {};
        if (material.alpha_mode == scene::AlphaMode::kMask) {
            material.alpha_mode = scene::AlphaMode::kOpaque;
        }
        // Highlights as narrow as a pixel turn depth's rounding into large differences.
        material.roughness = std::max(material.roughness, 0.3F);
    }
    room.materials[4].occlusion_strength = 0.5F;
    room.instances.erase(room.instances.begin() + 3); // a pane in the plane of the box's face
    scene::PunctualLight spot;
    spot.type = scene::LightType::kSpot;
    spot.position_world = {1, 4, 2};
    spot.direction_world = {0, -1, -0.2};
    spot.intensity = 20;
    scene::PunctualLight sun;
    sun.type = scene::LightType::kDirectional;
    sun.direction_world = {-0.4, -1, -0.6};
    sun.intensity = 0.5F;
    room.lights = {spot, sun};
    return room;
}

inline std::string nameOf(settings::Renderer renderer) {
    return std::string(settings::kRendererNames[static_cast<size_t>(renderer)]);
}

// Nearest texels, so that nothing is filtered: what is left is the driver's sRGB polynomial, and
// texels at whose edges a pixel lies.
inline scene::Scene makeNearestRoom() {
    auto room = makePlainRoom();
    room.samplers[0] = {.mag = scene::Filter::kNearest,
                        .min = scene::Filter::kNearest,
                        .mip = scene::Filter::kNearest,
                        .mipmapped = false};
    return room;
}

// Of the 99.9th percentile. Lavapipe leaves at most 1.4e-5 in the tests below.
inline double nearestBound() {
    return arithmeticBound(3e-5, settings::LightingStage::kFragment);
}

inline void
expectInBothStages(Compared& compared, const scene::Scene& room, double median, double p999) {
    for (const auto stage :
         {settings::LightingStage::kFragment, settings::LightingStage::kCompute}) {
        auto inputs = inputsFor(room.cameras[0].camera, settings::Renderer::kForwardPlus);
        inputs.settings.lighting = stage;
        // A GPU's rasteriser meets planes less exactly, and at texels' edges others.
        const double slack = onGpu() && stage == settings::LightingStage::kFragment ? 5 : 1;
        const Errors errors = compared.against(inputs);
        EXPECT_LT(errors.median, slack * median);
        EXPECT_LT(errors.p999, slack * p999);
    }
}

} // namespace froxel::test

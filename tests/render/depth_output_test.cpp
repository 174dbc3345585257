// The distance of what a frame shows, as floats beside its pixels.
#include "core/linear_image.h"
#include "render/view/renderer.h"
#include "support/gpu_fixture.h"
#include "support/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace froxel::test {
namespace {

using render::GeometryPath;
using settings::Renderer;

class DepthOutput : public SharedGpuTest {
  protected:
    // By row; empty: the frame has none.
    [[nodiscard]] static std::vector<float> depths(render::Renderer& renderer,
                                                   const render::FrameInputs& inputs) {
        render::ViewRenderer view(renderer);
        const auto submitted = view.submit(inputs);
        EXPECT_TRUE(submitted) << submitted.error().message;
        const auto frame = view.collect();
        EXPECT_TRUE(frame) << frame.error().message;
        return depthOf(frame->pixels.view());
    }
    [[nodiscard]] static render::FrameInputs inputsFor(const glm::dvec3& target) {
        render::FrameInputs inputs;
        inputs.settings.camera = settings::lookAt({0, 0, 0}, target, {0, 1, 0});
        inputs.settings.size = {50, 30};
        inputs.settings.lights.count = 3;
        inputs.outputs = {Output::kDepth};
        return inputs;
    }
};

// A wall across the view is as far away at every pixel, whichever way surfaces are drawn.
TEST_F(DepthOutput, WallAcrossTheView_IsAtItsDistance) {
    constexpr float kDistance_m = 7.25F;
    render::Renderer renderer(device(), wallAhead(kDistance_m).scene);
    for (const auto kind : {Renderer::kNaive, Renderer::kForwardPlus, Renderer::kClusteredDeferred,
                            Renderer::kToonCompute}) {
        for (const auto path :
             {GeometryPath::kRaster, GeometryPath::kVisibility, GeometryPath::kComputeRaster}) {
            SCOPED_TRACE(settings::kRendererNames[static_cast<size_t>(kind)]);
            auto inputs = inputsFor({0, 0, -1});
            inputs.settings.renderer = kind;
            inputs.geometry = path;
            const auto wall = depths(renderer, inputs);
            ASSERT_EQ(wall.size(), 50U * 30U);
            for (const float depth_m : wall) {
                ASSERT_NEAR(depth_m, kDistance_m, 1e-5F * kDistance_m);
            }
        }
    }
}

TEST_F(DepthOutput, WhereNothingIs_IsInfinite) {
    render::Renderer renderer(device(), wallAhead(2).scene);
    const auto behind = depths(renderer, inputsFor({0, 0, 1}));
    ASSERT_EQ(behind.size(), 50U * 30U);
    EXPECT_EQ(std::ranges::count(behind, std::numeric_limits<float>::infinity()),
              std::ssize(behind));
}

TEST_F(DepthOutput, OfFourSamples_IsTheNearest) {
    SceneMaker ball;
    ball.add(sphere(1, 12, 0), glm::translate(glm::dmat4(1), {0, 0, -3}));
    render::Renderer renderer(device(), ball.scene);
    auto inputs = inputsFor({0, 0, -1});
    inputs.settings.antialiasing = settings::Antialiasing::kSsaa4;
    const auto resolved = depths(renderer, inputs);
    inputs.settings.antialiasing = settings::Antialiasing::kNone;
    inputs.settings.size = {100, 60};
    const auto samples = depths(renderer, inputs);
    ASSERT_EQ(samples.size(), 4 * resolved.size());
    for (size_t i = 0; i < resolved.size(); ++i) {
        const float* first = &samples[i / 50 * 200 + i % 50 * 2];
        ASSERT_EQ(resolved[i], std::min({first[0], first[1], first[100], first[101]}));
    }
    EXPECT_TRUE(std::isinf(resolved.front()));
    EXPECT_NEAR(resolved[15 * 50 + 25], 2, 0.05);
}

TEST_F(DepthOutput, UnlessAskedFor_IsNotThere) {
    render::Renderer renderer(device(), wallAhead(2).scene);
    auto inputs = inputsFor({0, 0, -1});
    inputs.outputs = {};
    EXPECT_TRUE(depths(renderer, inputs).empty());
    inputs.outputs = {Output::kRadiance};
    EXPECT_TRUE(depths(renderer, inputs).empty());
}

} // namespace
} // namespace froxel::test

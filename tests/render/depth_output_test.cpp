// The distance of what a frame shows, as floats beside its pixels.
#include "core/depth_mesh.h"
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

// A mesh and all pixels of the same frame.
struct Mesh {
    DepthMeshSize size;
    std::vector<float> vertices; // 1/m
    std::vector<float> depths;   // m

    // Between vertices, as a rasteriser would.
    [[nodiscard]] double at(uint32_t x, uint32_t y) const {
        const double u = static_cast<double>(x) / kDepthCell_px;
        const double v = static_cast<double>(y) / kDepthCell_px;
        const auto column = std::min(static_cast<uint32_t>(u), size.columns - 2);
        const auto row = std::min(static_cast<uint32_t>(v), size.rows - 2);
        const auto vertex = [&](uint32_t right, uint32_t down) {
            return static_cast<double>(vertices[(row + down) * size.columns + column + right]);
        };
        const double across = u - column;
        const double down = v - row;
        return (vertex(0, 0) * (1 - across) + vertex(1, 0) * across) * (1 - down) +
               (vertex(0, 1) * (1 - across) + vertex(1, 1) * across) * down;
    }
};

Mesh meshOf(render::ViewRenderer& view, render::FrameInputs inputs) {
    inputs.outputs = {Output::kDepth, Output::kDepthMesh};
    EXPECT_TRUE(view.submit(inputs));
    const auto frame = view.collect();
    EXPECT_TRUE(frame) << frame.error().message;
    const PixelView& pixels = frame->pixels.view();
    const DepthMeshSize size(pixels.width_px, pixels.height_px);
    const float* vertices = pixels.output(Output::kDepthMesh);
    return {size, {vertices, vertices + size.vertexCount()}, depthOf(pixels)};
}

// Whole cells across and not down: 49 and 30 pixels, 7 x 5 vertices.
render::FrameInputs meshInputs(const glm::dvec3& target) {
    render::FrameInputs inputs;
    inputs.settings.camera = settings::lookAt({0, 0, 0}, target, {0, 1, 0});
    inputs.settings.size = {49, 30};
    inputs.settings.lights.count = 3;
    return inputs;
}

class DepthMeshOutput : public SharedGpuTest {};

TEST_F(DepthMeshOutput, SlantedWall_IsExactBetweenVertices) {
    render::Renderer renderer(device(), wallAhead(7.25F).scene);
    render::ViewRenderer view(renderer);
    for (const auto kind : {Renderer::kNaive, Renderer::kForwardPlus, Renderer::kClusteredDeferred,
                            Renderer::kToonCompute}) {
        for (const auto path :
             {GeometryPath::kRaster, GeometryPath::kVisibility, GeometryPath::kComputeRaster}) {
            for (const auto samples :
                 {settings::Antialiasing::kNone, settings::Antialiasing::kSsaa4}) {
                auto inputs = meshInputs({0.2, 0.1, -1});
                inputs.settings.renderer = kind;
                inputs.settings.antialiasing = samples;
                inputs.geometry = path;
                const Mesh mesh = meshOf(view, inputs);
                ASSERT_EQ(mesh.size, DepthMeshSize(49, 30));
                for (uint32_t y = 0; y <= 24; ++y) { // the last row's cell is a shorter one
                    for (uint32_t x = 0; x < 49; ++x) {
                        const double depth_m = mesh.depths[y * 49 + x];
                        // Of four samples the depth is the nearest's.
                        const double off = samples == settings::Antialiasing::kNone ? 2e-6 : 1e-3;
                        ASSERT_NEAR(mesh.at(x, y), 1 / depth_m, off) << x << "," << y;
                    }
                }
            }
        }
    }
}

TEST_F(DepthMeshOutput, AtARim_IsTheNearerSurface) {
    SceneMaker maker = wallAhead(20);
    maker.add(quad({0.1F, -5, -2}, {10, 0, 0}, {0, 10, 0}, 1, 0)); // right of the middle
    render::Renderer renderer(device(), maker.scene);
    render::ViewRenderer view(renderer);
    const Mesh mesh = meshOf(view, meshInputs({0, 0, -1}));
    uint32_t rim = 0; // the first pixel of the nearer one
    while (mesh.depths[15 * 49 + rim] > 10) {
        ++rim;
    }
    ASSERT_TRUE(rim > 24 && rim < 28) << rim;
    for (uint32_t column = 0; column < mesh.size.columns; ++column) {
        const bool near = column * kDepthCell_px + kDepthCell_px / 2 >= rim;
        EXPECT_NEAR(mesh.vertices[2 * mesh.size.columns + column], near ? 0.5 : 0.05, 1e-6);
    }
}

TEST_F(DepthMeshOutput, WhereNothingIs_IsZero) {
    render::Renderer renderer(device(), wallAhead(2).scene);
    render::ViewRenderer view(renderer);
    const Mesh mesh = meshOf(view, meshInputs({0, 0, 1}));
    EXPECT_EQ(std::ranges::count(mesh.vertices, 0.0F), std::ssize(mesh.vertices));
}

} // namespace
} // namespace froxel::test

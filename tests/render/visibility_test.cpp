// Pictures by way of visible triangles' ids: against the rasteriser's, and exact among themselves.
#include "builtin_scene/hall.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/test_scenes.h"
#include "support/visible_exact.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace froxel::test {

namespace {

using render::GeometryPath;
using settings::LightingStage;
using settings::Renderer;

class Visibility : public GpuTest {};

render::FrameInputs inputsFor(const settings::Camera& camera, Renderer renderer) {
    render::FrameInputs inputs;
    inputs.settings.camera = camera;
    inputs.settings.size = {240, 136};
    inputs.settings.renderer = renderer;
    inputs.settings.lights.count = 200;
    inputs.settings.light_loop = settings::LightLoop::kLists;
    inputs.time_s = 3.25;
    return inputs;
}

// Share of pixels with a channel of the 8-bit picture more than `steps` apart.
double shareApart(const Picture& a, const Picture& b, int steps) {
    EXPECT_EQ(a.rgba8.size(), b.rgba8.size());
    size_t count = 0;
    for (size_t i = 0; i + 3 < std::min(a.rgba8.size(), b.rgba8.size()); i += 4) {
        int worst = 0;
        for (size_t c = 0; c < 3; ++c) {
            worst = std::max(worst, std::abs(std::to_integer<int>(a.rgba8[i + c]) -
                                             std::to_integer<int>(b.rgba8[i + c])));
        }
        count += worst > steps ? 1U : 0U;
    }
    return static_cast<double>(count) / (static_cast<double>(a.rgba8.size()) / 4);
}

// Rounding moves a texture coordinate or a level of detail by little, and a coverage at an edge not
// at all: the rasteriser decides it in both.
void expectClose(const Picture& raster, const Picture& visible) {
    EXPECT_LT(shareApart(raster, visible, 1), 0.01);
    EXPECT_LT(shareApart(raster, visible, 8), 0.0005);
    EXPECT_GT(differingFloats(raster, Picture{}), 0U);
}

void expectLikeRaster(gpu::Device& device, const scene::Scene& scene) {
    render::Renderer renderer(device, scene);
    render::ViewRenderer view(renderer);
    for (const auto& camera : scene.cameras) {
        SCOPED_TRACE(camera.name);
        auto inputs = inputsFor(camera.camera, Renderer::kClusteredDeferred);
        inputs.geometry = GeometryPath::kRaster;
        const Picture raster = draw(view, inputs);
        inputs.geometry = GeometryPath::kVisibility;
        expectClose(raster, draw(view, inputs));

        inputs = inputsFor(camera.camera, Renderer::kForwardPlus);
        const Picture fragment = draw(view, inputs);
        inputs.settings.lighting = LightingStage::kCompute;
        expectClose(fragment, draw(view, inputs));
    }
}

// Every camera: lists against all lights, culled against not culled.
void expectExact(gpu::Device& device, const scene::Scene& scene) {
    render::Renderer renderer(device, scene);
    render::ViewRenderer view(renderer);
    for (const auto& camera : scene.cameras) {
        SCOPED_TRACE(camera.name);
        auto inputs = inputsFor(camera.camera, Renderer::kClusteredDeferred);
        inputs.geometry = GeometryPath::kVisibility;
        (void)expectVisibleExact(view, inputs);
    }
}

} // namespace

TEST_F(Visibility, Room_ById_LooksAsRastered) {
    expectLikeRaster(device(), makeRoom());
}

TEST_F(Visibility, Hall_ById_LooksAsRastered) {
    expectLikeRaster(device(), builtin_scene::makeHall());
}

TEST_F(Visibility, Sponza_ById_LooksAsRastered) {
    const auto scene = loadSponza();
    if (!scene) {
        GTEST_SKIP() << "Sponza is not here: set FROXEL_SPONZA to its .gltf file";
    }
    expectLikeRaster(device(), *scene);
}

TEST_F(Visibility, Room_ListsAndCulling_ChangeNothing) {
    expectExact(device(), makeRoom());
}

TEST_F(Visibility, Hall_ListsAndCulling_ChangeNothing) {
    expectExact(device(), builtin_scene::makeHall());
}

TEST_F(Visibility, Sponza_ListsAndCulling_ChangeNothing) {
    const auto scene = loadSponza();
    if (!scene) {
        GTEST_SKIP() << "Sponza is not here: set FROXEL_SPONZA to its .gltf file";
    }
    expectExact(device(), *scene);
}

TEST_F(Visibility, Orthographic_ById_LooksAsRastered) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    auto inputs = inputsFor(scene.cameras[0].camera, Renderer::kClusteredDeferred);
    inputs.settings.camera.projection = settings::Projection::kOrthographic;
    inputs.geometry = GeometryPath::kRaster;
    const Picture raster = draw(renderer, inputs);
    inputs.geometry = GeometryPath::kVisibility;
    const Picture visible = draw(renderer, inputs);
    expectClose(raster, visible);
    inputs.cull_meshlets = false;
    EXPECT_EQ(differingFloats(visible, draw(renderer, inputs)), 0U);
}

// Paths take turns over one set of targets, which grows and is replaced.
TEST_F(Visibility, Paths_ChangeInEveryFrame_GiveTheSamePictures) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (uint32_t i = 0; i < 24; ++i) {
        SCOPED_TRACE(i);
        auto inputs = inputsFor(scene.cameras[0].camera,
                                i % 3 == 0 ? Renderer::kNaive : Renderer::kToonCompute);
        inputs.settings.lighting = i % 6 == 0 ? LightingStage::kCompute : LightingStage::kAuto;
        inputs.geometry = i % 2 == 0 ? GeometryPath::kVisibility : GeometryPath::kRaster;
        inputs.settings.size = {160 + 16 * (i % 5), 90};
        const Picture picture = draw(view, inputs);
        EXPECT_EQ(differingFloats(picture, draw(renderer, inputs)), 0U);
    }
}

TEST_F(Visibility, Device_WithoutItsFeatures_IsToldInOneLine) {
    gpu::DeviceOptions options;
    options.visibility = false;
    openDevice(options);
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene.cameras[0].camera, Renderer::kForwardPlus);
    inputs.settings.lighting = LightingStage::kCompute;
    const auto refused = view.submit(inputs);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kUnsupported);
    EXPECT_THAT(refused.error().message, ::testing::HasSubstr("lighting: compute"));
    EXPECT_THAT(refused.error().message, ::testing::HasSubstr("use auto or fragment"));
    inputs.settings.lighting = LightingStage::kAuto;
    EXPECT_EQ(differingFloats(draw(view, inputs), draw(renderer, inputs)), 0U);
}

} // namespace froxel::test

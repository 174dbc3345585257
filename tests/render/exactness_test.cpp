// The exactness contract on pictures: a difference is a bug, not noise.
#include "builtin_scene/hall.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/test_scenes.h"
#include "support/tier.h"

#include <cmath>

namespace froxel::test {

namespace {

using settings::Renderer;

class Exactness : public GpuTest {};

render::FrameInputs inputsFor(const settings::Camera& camera, Renderer renderer) {
    render::FrameInputs inputs;
    inputs.settings.camera = camera;
    inputs.settings.size = {120, 68};
    inputs.settings.renderer = renderer;
    inputs.settings.light_loop = settings::LightLoop::kLists;
    inputs.time_s = 3.25;
    return inputs;
}

struct LightSet {
    uint32_t count = 0;
    float radius_m = 0;
};

// Of the contract each count and each radius, and many large ones; or all pairs.
std::vector<LightSet> lightSets() {
    if (!wholeGrids()) {
        return {{0, 2}, {1, 12}, {7, 0.5F}, {100, 2}, {1000, 0.5F}, {300, 12}};
    }
    std::vector<LightSet> sets;
    for (const uint32_t count : {0U, 1U, 7U, 100U, 1000U}) {
        for (const float radius_m : {0.5F, 2.0F, 12.0F}) {
            sets.push_back({count, radius_m});
        }
    }
    return sets;
}

// Lists against all lights.
void expectListsExact(render::Renderer& renderer, const scene::Scene& scene) {
    render::ViewRenderer view(renderer);
    for (const auto& camera : scene.cameras) {
        for (const auto& [count, radius_m] : lightSets()) {
            SCOPED_TRACE(camera.name + ", " + std::to_string(count) + " lights of " +
                         std::to_string(radius_m) + " m");
            auto inputs = inputsFor(camera.camera, Renderer::kNaive);
            inputs.settings.lights.count = count;
            inputs.settings.lights.radius_m = radius_m;
            const Picture naive = draw(view, inputs);
            inputs.settings.renderer = Renderer::kForwardPlus;
            EXPECT_EQ(differingFloats(naive, draw(view, inputs)), 0U);

            inputs.settings.renderer = Renderer::kClusteredDeferred;
            const Picture clustered = draw(view, inputs);
            inputs.settings.light_loop = settings::LightLoop::kAllLights;
            EXPECT_EQ(differingFloats(clustered, draw(view, inputs)), 0U);
        }
    }
}

} // namespace

TEST_F(Exactness, Lists_BuiltinScene_EqualAllLightsBitForBit) {
    const auto scene = builtin_scene::makeHall();
    render::Renderer renderer(device(), scene);
    expectListsExact(renderer, scene);
}

TEST_F(Exactness, Lists_Sponza_EqualAllLightsBitForBit) {
    const auto scene = loadSponza();
    if (!scene) {
        GTEST_SKIP() << "Sponza is not here: set FROXEL_SPONZA to its .gltf file";
    }
    ASSERT_EQ(scene->cameras.size(), 4U);
    render::Renderer renderer(device(), *scene);
    expectListsExact(renderer, *scene);
}

// Coats face lights that what is below them does not. Fewer cases than of other scenes: what else
// there is to a list is the same.
TEST_F(Exactness, Lists_Layers_EqualAllLightsBitForBit) {
    auto scene = makeRoom();
    giveCoats(scene);
    giveLobes(scene);
    render::Renderer renderer(device(), scene);
    for (const auto transparency :
         {settings::Transparency::kSorted, settings::Transparency::kWeighted,
          settings::Transparency::kPeeled}) {
        for (const float radius : {0.5F, 4.0F}) {
            if (!wholeGrids() &&
                (radius < 1) != (transparency == settings::Transparency::kPeeled)) {
                continue;
            }
            auto inputs = inputsFor(scene.cameras[1].camera, Renderer::kNaive);
            inputs.settings.lights.count = 300;
            inputs.settings.lights.radius_m = radius;
            inputs.settings.transparency = transparency;
            inputs.settings.shadows.light_count = 4;
            const Picture naive = draw(renderer, inputs);
            inputs.settings.renderer = Renderer::kForwardPlus;
            EXPECT_EQ(differingFloats(naive, draw(renderer, inputs)), 0U);
            inputs.settings.lighting = settings::LightingStage::kCompute;
            const Picture shaded = draw(renderer, inputs);
            inputs.settings.light_loop = settings::LightLoop::kAllLights;
            EXPECT_EQ(differingFloats(shaded, draw(renderer, inputs)), 0U);
            inputs.settings.renderer = Renderer::kClusteredDeferred;
            const Picture all = draw(renderer, inputs);
            inputs.settings.light_loop = settings::LightLoop::kLists;
            EXPECT_EQ(differingFloats(all, draw(renderer, inputs)), 0U);
        }
    }
}

// What the G-buffer has no room for is drawn over it: a deferred picture is the forward one where
// all has layers, whichever stage lights the rest. By one rasteriser, as layers are drawn.
TEST_F(Exactness, Layers_OfEveryRenderer_AreTheForwardOnes) {
    auto scene = makeRoom();
    giveCoats(scene);
    giveLobes(scene);
    scene.materials[1] = scene.materials[0];
    render::Renderer renderer(device(), scene);
    auto inputs = inputsFor(scene.cameras[1].camera, Renderer::kForwardPlus);
    inputs.settings.lights.count = 100;
    inputs.geometry = render::GeometryPath::kRaster;
    const Picture forward = draw(renderer, inputs);
    inputs.settings.renderer = Renderer::kClusteredDeferred;
    for (const auto stage :
         {settings::LightingStage::kCompute, settings::LightingStage::kFragment}) {
        inputs.settings.lighting = stage;
        EXPECT_EQ(differingFloats(forward, draw(renderer, inputs)), 0U);
    }
}

TEST_F(Exactness, Grids_AnySize_GiveTheSamePicture) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    auto inputs = inputsFor(scene.cameras[0].camera, Renderer::kClusteredDeferred);
    inputs.settings.lights.count = 300;
    const Picture reference = draw(renderer, inputs);
    for (const settings::GridSize grid : {settings::GridSize{1, 1, 1},
                                          {16, 16, 24},
                                          {15, 15, 15},
                                          {32, 16, 64},
                                          {128, 128, 3},
                                          {7, 1, 256}}) {
        for (const auto law : {settings::GridLaw::kLogarithmic, settings::GridLaw::kLinear,
                               settings::GridLaw::kHyperbolic}) {
            inputs.settings.grid = {.automatic = false, .size = grid, .law = law};
            EXPECT_EQ(differingFloats(reference, draw(renderer, inputs)), 0U)
                << grid.x << "x" << grid.y << "x" << grid.z;
        }
    }
}

TEST_F(Exactness, LightingStage_FragmentOrCompute_GivesTheSamePicture) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    for (const auto kind :
         {Renderer::kClusteredDeferred, Renderer::kToonFragment, Renderer::kToonCompute}) {
        auto inputs = inputsFor(scene.cameras[0].camera, kind);
        inputs.settings.lights.count = 200;
        const Picture compute = draw(renderer, inputs);
        inputs.settings.lighting = settings::LightingStage::kFragment;
        EXPECT_EQ(differingFloats(compute, draw(renderer, inputs)), 0U)
            << settings::kRendererNames[static_cast<size_t>(kind)];
    }
}

TEST_F(Exactness, Subgroups_WithAndWithout_GiveTheSamePicture) {
    const auto scene = makeRoom();
    std::vector<Picture> with;
    for (const bool subgroups : {true, false}) {
        gpu::DeviceOptions options;
        options.subgroups = subgroups;
        openDevice(options);
        render::Renderer renderer(device(), scene);
        for (size_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
            auto inputs = inputsFor(scene.cameras[0].camera, static_cast<Renderer>(kind));
            inputs.settings.lights.count = 150;
            Picture picture = draw(renderer, inputs);
            if (subgroups) {
                with.push_back(std::move(picture));
            } else {
                EXPECT_EQ(differingFloats(with[kind], picture), 0U)
                    << settings::kRendererNames[kind];
            }
        }
    }
}

// A million lights through every pixel would take minutes, which nobody could cancel.
TEST_F(Exactness, LightsThatTakeMinutes_AreRefused_AndTheNextFrameIsDrawn) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene.cameras[0].camera, Renderer::kNaive);
    const Picture before = draw(view, inputs);
    auto many = inputs;
    many.settings.size = {1920, 1080};
    many.settings.lights.count = 1'000'000;
    for (const auto kind : {Renderer::kNaive, Renderer::kForwardPlus, Renderer::kToonCompute}) {
        many.settings.renderer = kind;
        many.settings.light_loop = settings::LightLoop::kAllLights;
        const auto refused = view.submit(many);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::kTooLong);
    }
    EXPECT_EQ(differingFloats(before, draw(view, inputs)), 0U);
}

TEST_F(Exactness, Frames_SameInputTwice_SameBytes) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (size_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
        auto inputs = inputsFor(scene.cameras[1].camera, static_cast<Renderer>(kind));
        inputs.settings.lights.count = 200;
        const Picture first = draw(view, inputs);
        inputs.time_s = 99; // something else in between
        EXPECT_GT(differingFloats(first, draw(view, inputs)), 0U);
        inputs.time_s = 3.25;
        const Picture again = draw(view, inputs);
        EXPECT_EQ(differingFloats(first, again), 0U) << settings::kRendererNames[kind];
        EXPECT_EQ(first.rgba8, again.rgba8) << settings::kRendererNames[kind];
    }
}

TEST_F(Exactness, Pictures_AnyOddSize_AreFiniteAndEqual) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (const settings::Size size :
         {settings::Size{17, 33}, {119, 16}, {16, 131}, {64, 64}, {16, 16}}) {
        auto inputs = inputsFor(scene.cameras[0].camera, Renderer::kNaive);
        inputs.settings.size = size;
        inputs.settings.lights.count = 100;
        const Picture naive = draw(view, inputs);
        ASSERT_EQ(naive.radiance.size(), size_t{3} * size.width_px * size.height_px);
        for (const float value : naive.radiance) {
            ASSERT_TRUE(std::isfinite(value));
        }
        inputs.settings.renderer = Renderer::kForwardPlus;
        EXPECT_EQ(differingFloats(naive, draw(view, inputs)), 0U)
            << size.width_px << "x" << size.height_px;
    }
}

TEST_F(Exactness, Scene_FarFromTheOrigin_LooksTheSame) {
    auto near_scene = makeRoom();
    auto far_scene = near_scene;
    const glm::dvec3 away(1'048'576, -524'288, 2'097'152); // exact in double and in the offsets
    for (auto& instance : far_scene.instances) {
        instance.world_from_object[3] += glm::dvec4(away, 0);
    }
    far_scene.bounds_world = {near_scene.bounds_world.min + away,
                              near_scene.bounds_world.max + away};
    auto inputs = inputsFor(near_scene.cameras[0].camera, Renderer::kClusteredDeferred);
    inputs.settings.lights.count = 0;
    render::Renderer near_renderer(device(), near_scene);
    render::Renderer far_renderer(device(), far_scene);
    const Picture reference = draw(near_renderer, inputs);
    inputs.settings.camera.eye_world += away;
    const Picture moved = draw(far_renderer, inputs);
    EXPECT_EQ(differingFloats(reference, moved), 0U);
}

// Targets come and go with size and renderer; nothing may look at one that went.
TEST_F(Exactness, Targets_SizeAndRendererChangeInEveryFrame_GiveTheSamePicture) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (uint32_t i = 0; i < 60; ++i) {
        SCOPED_TRACE(i);
        auto inputs = inputsFor(scene.cameras[0].camera,
                                i % 2 == 0 ? Renderer::kClusteredDeferred : Renderer::kForwardPlus);
        inputs.settings.size = {160 + 16 * (i % 7), 90 + 4 * (i % 5)};
        inputs.settings.lights.count = 20;
        const Picture picture = draw(view, inputs);
        EXPECT_EQ(differingFloats(picture, draw(renderer, inputs)), 0U);
    }
}

} // namespace froxel::test

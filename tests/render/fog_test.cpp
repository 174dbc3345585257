// Fog against closed forms, against lights integrated in double, and against itself.
#include "builtin_scene/hall.h"
#include "fog_pictures.h"
#include "reference/rays.h"
#include "reference/shade.h"
#include "render/view/visibility_readback.h"
#include "settings/environment.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/shapes.h"
#include "support/test_scenes.h"
#include "support/tier.h"

#include <algorithm>
#include <cmath>

namespace froxel::test {

namespace {

using settings::Renderer;
using ::testing::Contains;
using ::testing::Key;
using ::testing::Not;

class Fog : public SharedGpuTest {
  protected:
    [[nodiscard]] static std::map<std::string, uint64_t> memory() {
        return device().memoryLedger()->byPurpose();
    }
};

} // namespace

// No light but that from all around: exp(-density d) of the surface, the rest from the air.
TEST_F(Fog, ConstantWithoutLights_IsTheClosedForm) {
    auto maker = wallAhead(4);
    maker.scene.materials[0].unlit = true;
    render::Renderer renderer(device(), maker.scene);
    for (const auto projection :
         {settings::Projection::kPerspective, settings::Projection::kOrthographic}) {
        auto inputs = inputsFor(ahead(), 0);
        inputs.settings.renderer = Renderer::kForwardPlus; // whose colours are not rounded
        inputs.settings.camera.projection = projection;
        inputs.settings.camera.half_height_m = 12;         // past the wall's edge
        inputs.settings.camera.lens_shift = {0.31, -0.21}; // no centre on an edge
        const reference::PixelRays rays(inputs.settings.camera, kSize);
        for (const float density : {0.001F, 0.1F, 2.0F, 50.0F}) {
            inputs.settings.fog.density = density;
            const Picture picture = draw(renderer, inputs);
            EXPECT_THAT(passesOf(picture), Not(Contains("fog_scatter")));
            double worst = 0;
            size_t covered = 0;
            for (uint32_t y = 0; y < kSize.height_px; ++y) {
                for (uint32_t x = 0; x < kSize.width_px; ++x) {
                    const auto ray = rays.through(x, y);
                    const glm::dvec3 at = ray.origin + ray.direction * 4.0;
                    const bool wall = std::max(std::abs(at.x), std::abs(at.y)) < 10;
                    covered += wall ? 1U : 0U;
                    const double kept = wall ? std::exp(-static_cast<double>(density) *
                                                        glm::length(ray.direction * 4.0))
                                             : 0.0;
                    for (int c = 0; c < 3; ++c) {
                        const auto air = 0.5 * static_cast<double>(settings::kAmbientSky[c] +
                                                                   settings::kAmbientGround[c]);
                        const double right = kept * 1.0 + (1 - kept) * air;
                        const size_t i = 3 * (size_t{y} * kSize.width_px + x);
                        const auto drawn =
                            static_cast<double>(picture.radiance[i + static_cast<size_t>(c)]);
                        worst = std::max(worst, std::abs(drawn - right) / right);
                    }
                }
            }
            EXPECT_LT(worst, 2e-5) << density;
            EXPECT_GT(covered, 500U);
        }
    }
}

// White air lights nothing up and dims nothing where all around has one radiance.
TEST_F(Fog, Furnace_OfAlbedoOne_ShowsNothing) {
    auto maker = insideOfABox(5);
    auto& walls = maker.scene.materials[0];
    const glm::vec3 around = 0.5F * (settings::kAmbientSky + settings::kAmbientGround);
    walls.unlit = true;
    walls.base_color = glm::vec4(around, 1);
    render::Renderer renderer(device(), maker.scene);
    auto inputs = inputsFor(ahead(), 0);
    inputs.settings.renderer = Renderer::kForwardPlus;
    for (const float falloff : {0.0F, 0.7F}) {
        for (const float density : {0.01F, 0.5F, 10.0F}) {
            inputs.settings.fog = {.density = density, .height_falloff = falloff};
            const Picture picture = draw(renderer, inputs);
            for (size_t i = 0; i < picture.radiance.size(); ++i) {
                const float right = around[static_cast<int>(i % 3)];
                ASSERT_NEAR(picture.radiance[i], right, 1e-5F * right) << density;
            }
        }
    }
}

TEST_F(Fog, NoDensity_IsNoFogBitForBit) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene.cameras[0].camera, 30);
    (void)draw(view, inputs); // which measures the overdraw
    const Picture without = draw(view, inputs);
    inputs.settings.fog = {.density = 0, .height_falloff = 1, .half_rate = true, .noise = true};
    const Picture none = draw(view, inputs);
    EXPECT_EQ(differingFloats(without, none), 0U);
    EXPECT_EQ(without.rgba8, none.rgba8);
    EXPECT_THAT(memory(), Not(Contains(Key("fog volume"))));
    EXPECT_EQ(passesOf(without), passesOf(none));
    inputs.settings.fog = {.density = 0.1F, .albedo = {0, 0, 0}}; // takes light and gives none
    EXPECT_THAT(passesOf(draw(view, inputs)), Not(Contains("fog_scatter")));
    inputs.settings.fog.albedo = {1, 1, 1};
    const auto passes = passesOf(draw(view, inputs));
    for (const char* name : {"fog_scatter", "fog_integrate", "fog"}) {
        EXPECT_THAT(passes, Contains(name));
    }
    const uint64_t bytes = memory()["fog volume"];
    EXPECT_GE(bytes, 11U * 7 * 64 * 16); // nodes of 160 x 90 pixels by 16, of four floats
    EXPECT_LT(bytes, 11U * 7 * 64 * 16 + 65'536);
    inputs.settings.fog.half_rate = true;
    (void)draw(view, inputs);
    EXPECT_LT(memory()["fog volume"], bytes);
    inputs.settings.fog = {};
    EXPECT_EQ(differingFloats(without, draw(view, inputs)), 0U);
    EXPECT_THAT(memory(), Not(Contains(Key("fog volume"))));
}

// The lists of empty space are whole: also behind the scene and at the eye.
TEST_F(Fog, Lists_EqualAllLightsBitForBit) {
    const auto scene = makeRoom(); // with glass
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (size_t camera = 0; camera < 3; ++camera) {
        for (const float radius : {0.3F, 2.0F, 9.0F}) {
            SCOPED_TRACE("camera " + std::to_string(camera) + ", " + std::to_string(radius) + " m");
            auto inputs = inputsFor(scene.cameras[0].camera, 150);
            if (camera == 1) {
                inputs.settings.camera.projection = settings::Projection::kOrthographic;
                inputs.settings.camera.half_height_m = 3;
            } else if (camera == 2) {
                inputs.settings.camera.lens_shift = {0.7, -0.4};
            }
            inputs.settings.lights.radius_m = radius;
            inputs.settings.lights.box = BoundsD3{{-6, -2, -9}, {6, 5, 9}}; // around the room
            inputs.settings.fog = {.density = 0.05F, .height_falloff = 0.1F, .anisotropy = 0.5F};
            inputs.settings.renderer = Renderer::kNaive;
            const Picture naive = draw(view, inputs);
            for (const float value : naive.radiance) {
                ASSERT_TRUE(std::isfinite(value));
            }
            inputs.settings.renderer = Renderer::kForwardPlus;
            EXPECT_EQ(differingFloats(naive, draw(view, inputs)), 0U);
            inputs.settings.renderer = Renderer::kClusteredDeferred;
            const Picture clustered = draw(view, inputs);
            inputs.settings.lighting = settings::LightingStage::kFragment;
            EXPECT_EQ(differingFloats(clustered, draw(view, inputs)), 0U);
            inputs.settings.light_loop = settings::LightLoop::kAllLights;
            EXPECT_EQ(differingFloats(clustered, draw(view, inputs)), 0U);
        }
    }
}

TEST_F(Fog, Grids_AnyLawAndSize_GiveTheSamePicture) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene.cameras[0].camera, 200);
    inputs.settings.fog.density = 0.1F;
    const Picture first = draw(view, inputs);
    for (const settings::GridSize grid :
         {settings::GridSize{1, 1, 1}, {15, 15, 15}, {128, 128, 3}}) {
        for (const auto law : {settings::GridLaw::kLogarithmic, settings::GridLaw::kLinear,
                               settings::GridLaw::kHyperbolic}) {
            inputs.settings.grid = {.automatic = false, .size = grid, .law = law};
            EXPECT_EQ(differingFloats(first, draw(view, inputs)), 0U) << grid.x;
        }
    }
}

// Finer volumes come to what is integrated in double; the figures are in docs/figures/effects.md.
TEST_F(Fog, FinerVolumes_ComeToTheReference) {
    const auto maker = lampsInTheAir();
    render::Renderer renderer(device(), maker.scene);
    auto inputs = inputsFor(ahead(), 0);
    inputs.settings.renderer = Renderer::kForwardPlus;
    inputs.settings.shading = settings::ShadingModel::kLambert;
    const std::pair<const char*, settings::Fog> media[] = {
        {"thin", {.density = 0.02F}},
        {"onwards", {.density = 0.1F, .anisotropy = 0.6F, .albedo = {0.9F, 0.6F, 0.3F}}},
        {"by height", {.density = 0.3F, .height_falloff = 0.8F, .base_height_m = -1}},
        {"dense", {.density = 1.5F}}};
    for (const auto& [name, fog] : media) {
        SCOPED_TRACE(name);
        inputs.settings.fog = fog;
        const LinearImage reference = meant(renderer, maker.scene, inputs);
        std::vector<double> errors;
        for (const auto& [tile, slices] :
             {std::pair(32U, 32U), {16U, 64U}, {8U, 128U}, {4U, 256U}}) {
            inputs.settings.fog.tile_px = tile;
            inputs.settings.fog.slice_count = slices;
            errors.push_back(errorOf(renderer, reference, inputs));
        }
        EXPECT_LT(errors[1], errors[0]);
        EXPECT_LT(errors[2], errors[1]);
        EXPECT_LT(errors[3], errors[2]);
        EXPECT_LT(errors[3], 0.025);
        inputs.settings.fog.tile_px = 8;
        inputs.settings.fog.slice_count = 128;
        inputs.settings.fog.half_rate = true; // is 16 px and 64 slices
        EXPECT_EQ(errorOf(renderer, reference, inputs), errors[1]);
    }
}

// A sun's light in the air needs no volume: forwards, to all sides and backwards.
TEST_F(Fog, SunAlone_IsAsIntegratedInDouble) {
    auto maker = wallAhead(4);
    scene::PunctualLight sun;
    sun.type = scene::LightType::kDirectional;
    sun.direction_world = {0.5, -0.7, 0.6};
    sun.intensity = 3;
    maker.scene.lights = {sun};
    render::Renderer renderer(device(), maker.scene);
    auto inputs = inputsFor(ahead(), 0);
    inputs.settings.renderer = Renderer::kForwardPlus;
    for (const float g : {-0.6F, 0.0F, 0.6F}) {
        inputs.settings.fog = {.density = 0.2F, .anisotropy = g};
        EXPECT_LT(errorOf(renderer, meant(renderer, maker.scene, inputs), inputs), 1e-4) << g;
    }
}

// A narrow cone across the view: without it the whole ball would shine.
TEST_F(Fog, SpotAlone_ScattersWithinItsCone) {
    auto maker = insideOfABox(8);
    maker.spot({-3, 2, -5}, {0.7, -0.5, 0}, 9, 20, 30);
    render::Renderer renderer(device(), maker.scene);
    auto inputs = inputsFor(ahead(), 0);
    inputs.settings.renderer = Renderer::kForwardPlus;
    inputs.settings.shading = settings::ShadingModel::kLambert;
    inputs.settings.lights.ambient = 0;
    inputs.settings.fog = {.density = 0.05F};
    inputs.settings.fog.tile_px = 4;
    inputs.settings.fog.slice_count = 256;
    EXPECT_LT(errorOf(renderer, meant(renderer, maker.scene, inputs), inputs), 0.1);
}

// Blended surfaces, parallel rays, an off-centre lens, the eye within lights; by every renderer
// that the reference knows.
TEST_F(Fog, Room_IsAsIntegratedInDouble) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    for (const bool parallel : {false, true}) {
        auto inputs = inputsFor(scene.cameras[0].camera, 12);
        inputs.settings.lights.radius_m = 5;
        inputs.settings.shading = settings::ShadingModel::kLambert;
        inputs.settings.renderer = Renderer::kForwardPlus;
        if (parallel) {
            inputs.settings.camera.projection = settings::Projection::kOrthographic;
            inputs.settings.camera.half_height_m = 2;
        }
        inputs.settings.camera.lens_shift = {0.2, 0.1};
        inputs.settings.fog = {.density = 0.08F, .anisotropy = 0.3F};
        inputs.settings.fog.tile_px = 4;
        inputs.settings.fog.slice_count = 128;
        const LinearImage with = meant(renderer, scene, inputs);
        const double error = errorOf(renderer, with, inputs);
        auto clear = inputs;
        clear.settings.fog = {};
        const double before = errorOf(renderer, meant(renderer, scene, clear), clear);
        EXPECT_LT(error, before + 0.02) << parallel; // textures' filters and normal maps
        // Without the surfaces' fog the picture would be far off.
        EXPECT_GT(errorOf(renderer, with, clear), 0.1);
    }
}

// A lamp behind a screen: the air in its shadow is dark. Rays in double say where; a slice is lit
// or not by its middle, so the rest is at the shaft's edges.
TEST_F(Fog, ShadowsFall_IntoTheAir) {
    SceneMaker maker = wallAhead(6);
    maker.add(quad({-0.6F, -0.6F, -3.2F}, {1.2F, 0, 0}, {0, 1.2F, 0}, 1, 0));
    maker.point({0.2, 0.1, -4}, 5, 6);
    maker.spot({-2, 2, -4.5}, {0.7, -0.7, 0.1}, 6, 25, 35);
    render::Renderer renderer(device(), maker.scene);
    auto inputs = inputsFor(ahead(), 0);
    inputs.settings.fog = {.density = 0.1F, .anisotropy = 0.2F};
    inputs.settings.fog.tile_px = 4;
    inputs.settings.fog.slice_count = 128;
    inputs.settings.lights.ambient = 0;
    inputs.settings.shading = settings::ShadingModel::kLambert;
    const double before = errorOf(renderer, meant(renderer, maker.scene, inputs), inputs);
    auto shadowed = inputs;
    shadowed.settings.shadows = {2, 512};
    const LinearImage right = meant(renderer, maker.scene, shadowed);
    EXPECT_LT(errorOf(renderer, right, shadowed), before + 0.03);
    EXPECT_GT(errorOf(renderer, right, inputs), 0.15);
    for (const auto kind : {Renderer::kForwardPlus, Renderer::kClusteredDeferred}) {
        shadowed.settings.renderer = kind;
        const Picture lists = draw(renderer, shadowed);
        auto all = shadowed;
        all.settings.light_loop = settings::LightLoop::kAllLights;
        all.settings.renderer = kind == Renderer::kForwardPlus ? Renderer::kNaive : kind;
        EXPECT_EQ(differingFloats(lists, draw(renderer, all)), 0U);
    }
}

TEST_F(Fog, Frames_ArePureFunctionsOfTheirInputs) {
    const auto maker = lampsInTheAir();
    render::Renderer renderer(device(), maker.scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(ahead(), 0); // lamps that stand still
    inputs.settings.fog.density = 0.1F;
    const Picture first = draw(view, inputs);
    inputs.time_s = 7;
    EXPECT_EQ(differingFloats(first, draw(view, inputs)), 0U); // no noise: time is nothing
    inputs.settings.fog.noise = true;
    const Picture noisy = draw(view, inputs);
    EXPECT_GT(differingFloats(first, noisy), 0U);
    inputs.time_s = 8;
    EXPECT_GT(differingFloats(noisy, draw(view, inputs)), 0U);
    inputs.time_s = 7;
    EXPECT_EQ(differingFloats(noisy, draw(renderer, inputs)), 0U); // also by another viewer
}

// The volume's tiles are of pixels, so four samples of one see the same volume.
TEST_F(Fog, FourSamples_AreThePictureOfTwiceTheSidesInItsMean) {
    const auto maker = lampsInTheAir();
    render::Renderer renderer(device(), maker.scene);
    auto inputs = inputsFor(ahead(), 0);
    inputs.settings.fog.density = 0.1F;
    inputs.settings.bloom = {settings::BloomKind::kNone};
    inputs.settings.antialiasing = settings::Antialiasing::kSsaa4;
    const Picture resolved = draw(renderer, inputs);
    inputs.settings.antialiasing = settings::Antialiasing::kNone;
    inputs.settings.size = {2 * kSize.width_px, 2 * kSize.height_px};
    inputs.settings.fog.tile_px = 32;
    const Picture samples = draw(renderer, inputs);
    ASSERT_EQ(resolved.radiance.size() * 4, samples.radiance.size());
    for (uint32_t i = 0; i < resolved.radiance.size(); ++i) {
        const uint32_t x = i / 3 % kSize.width_px;
        const uint32_t y = i / 3 / kSize.width_px;
        double sum = 0;
        for (uint32_t s = 0; s < 4; ++s) {
            const size_t at = size_t{2 * y + s / 2} * samples.width_px + 2 * x + s % 2;
            sum += 0.25 * static_cast<double>(samples.radiance[3 * at + i % 3]);
        }
        ASSERT_NEAR(resolved.radiance[i], sum, 1e-5 * sum);
    }
}

// Debug views in the picture's place show surfaces, and those over it lie on the fog.
TEST_F(Fog, DebugViews_AreNotFogged) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene.cameras[0].camera, 20);
    for (const auto debug : {settings::DebugView::kNormal, settings::DebugView::kBaseColor}) {
        inputs.settings.debug.view = debug;
        inputs.settings.fog.density = 0;
        const Picture without = drawPixels(view, inputs);
        inputs.settings.fog.density = 0.5F;
        const Picture with = drawPixels(view, inputs);
        EXPECT_EQ(without.rgba8, with.rgba8);
        EXPECT_THAT(passesOf(with), Not(Contains("fog")));
    }
    inputs.settings.debug.view = settings::DebugView::kLightSpheres;
    const auto passes = passesOf(drawPixels(view, inputs));
    EXPECT_THAT(passes, Contains("fog"));
    EXPECT_THAT(passes, Contains("wires"));
}

// Fog, shadows, glass by every order, area lights, bloom, outlines and a filter at once: lists are
// as exact as with none of them.
TEST_F(Fog, WithAllElse_EveryRendererIsFiniteRepeatsAndIsExact) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (size_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
        auto inputs = inputsFor(scene.cameras[0].camera, 40);
        inputs.settings.renderer = static_cast<Renderer>(kind);
        const Picture clear = draw(view, inputs);
        inputs.settings.fog = {.density = 0.1F, .height_falloff = 0.2F, .noise = true};
        inputs.settings.bloom.kind = settings::BloomKind::kMipChain;
        inputs.settings.toon_outline.strength = 0.5F;
        inputs.settings.antialiasing = settings::Antialiasing::kFxaa;
        inputs.settings.shadows = {8, 128};
        settings::PlacedLight area;
        area.id = 1;
        area.kind = settings::LightKind::kArea;
        area.position_world = {0, 2.5, 0};
        area.radius_m = 4;
        inputs.settings.lights.placed = settings::PlacedLights({area});
        for (size_t order = 0; order < settings::kTransparencyNames.size(); ++order) {
            if (!wholeGrids() && order != kind % settings::kTransparencyNames.size()) {
                continue;
            }
            SCOPED_TRACE(std::string(settings::kRendererNames[kind]) + ", " +
                         std::string(settings::kTransparencyNames[order]));
            inputs.settings.transparency = static_cast<settings::Transparency>(order);
            const Picture picture = draw(view, inputs);
            for (const float value : picture.radiance) {
                ASSERT_TRUE(std::isfinite(value));
            }
            EXPECT_GT(differingFloats(clear, picture), 0U);
            EXPECT_EQ(picture.rgba8, draw(view, inputs).rgba8);
            auto all = inputs;
            all.settings.light_loop = settings::LightLoop::kAllLights;
            EXPECT_EQ(differingFloats(picture, draw(view, all)), 0U);
        }
    }
}

TEST_F(Fog, TooManyFroxels_AreRefusedAndTheNextFrameIsDrawn) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene.cameras[0].camera, 5);
    inputs.settings.fog.density = 0.1F;
    const Picture before = draw(view, inputs);
    auto many = inputs;
    many.settings.size = {3840, 2160};
    many.settings.fog.tile_px = 4;
    many.settings.fog.slice_count = 256;
    const auto refused = view.submit(many);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kCapacity);
    EXPECT_THAT(refused.error().message, ::testing::HasSubstr("fog_tile and fog_slices"));
    EXPECT_EQ(differingFloats(before, draw(view, inputs)), 0U);
}

} // namespace froxel::test

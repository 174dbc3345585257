// Shading models against their formulas, and the loops' variants against each other, bit for bit.
#include "settings/camera.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/shapes.h"
#include "support/test_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace froxel::test {

namespace {

using settings::LightingStage;
using settings::LightLoop;
using settings::Renderer;
using settings::ShadingModel;

class Shading : public GpuTest {};

// A white floor 40 m wide at y = 0; metallic and rough as a material is by default.
scene::Scene makeFloor() {
    scene::Primitive floor;
    floor.positions = {{-20, 0, 20}, {20, 0, 20}, {20, 0, -20}, {-20, 0, -20}};
    floor.normals.assign(4, {0, 1, 0});
    floor.indices = {0, 1, 2, 0, 2, 3};
    for (const auto& position : floor.positions) {
        floor.bounds.add(position);
    }
    scene::Scene scene;
    scene.materials = {{}};
    scene.meshes = {{"floor", {floor}}};
    scene.instances = {{}};
    scene.bounds_world.add(glm::dvec3(-20, 0, -20));
    scene.bounds_world.add(glm::dvec3(20, 3, 20));
    return scene;
}

void addPoint(scene::Scene& scene, const glm::dvec3& position, float range_m) {
    scene::PunctualLight light;
    light.position_world = position;
    light.color = {1.0F, 0.5F, 0.25F};
    light.intensity = 2;
    light.range_m = range_m;
    scene.lights.push_back(light);
}

render::FrameInputs inputsFor(const settings::Camera& camera, Renderer renderer) {
    render::FrameInputs inputs;
    inputs.settings.camera = camera;
    inputs.settings.size = {96, 54};
    inputs.settings.renderer = renderer;
    inputs.settings.light_loop = LightLoop::kLists;
    inputs.settings.lights.ambient = 0;
    inputs.time_s = 1.5;
    return inputs;
}

// Irradiance of the white light that makeFloor()'s lights share, at a point of the floor.
double irradianceOnFloor(const scene::Scene& scene, const glm::dvec3& point) {
    double sum = 0;
    for (const auto& light : scene.lights) {
        const glm::dvec3 to_light = light.position_world - point;
        const double d2 = glm::dot(to_light, to_light);
        const double range = static_cast<double>(light.range_m);
        const double x = range > 0 ? d2 / (range * range) : 0.0;
        const double window = std::max(0.0, 1 - x * x);
        const double facing = std::max(0.0, to_light.y) / std::sqrt(d2);
        sum += 2 * window * window / std::max(d2, 1e-4) * facing;
    }
    return sum;
}

// Where the ray through a pixel's centre meets the floor.
glm::dvec3
floorAt(const settings::Camera& camera, const settings::Size& size, uint32_t x, uint32_t y) {
    const double half = std::tan(camera.yfov_rad * 0.5);
    const double aspect = static_cast<double>(size.width_px) / size.height_px;
    const glm::dvec3 ray(((x + 0.5) / size.width_px * 2 - 1) * half * aspect,
                         (1 - (y + 0.5) / size.height_px * 2) * half, -1);
    const glm::dvec3 ray_world = camera.world_from_view * ray;
    return camera.eye_world - ray_world * (camera.eye_world.y / ray_world.y);
}

std::string nameOf(Renderer renderer) {
    return std::string(settings::kRendererNames[static_cast<size_t>(renderer)]);
}

} // namespace

TEST_F(Shading, LambertOnAFloor_AnyRenderer_IsAlbedoOverPiTimesIrradiance) {
    auto scene = makeFloor();
    addPoint(scene, {0, 1.0, 0}, 4);
    addPoint(scene, {1.5, 0.4, -1}, 2.5F);
    addPoint(scene, {-2, 2.0, 1}, 0);
    addPoint(scene, {0.5, -1.0, 0}, 5); // below the floor
    const auto camera = settings::lookAt({0.5, 4, 5}, {0, 0, 0}, {0, 1, 0});
    render::Renderer renderer(device(), scene);
    for (const auto kind :
         {Renderer::kNaive, Renderer::kForwardPlus, Renderer::kClusteredDeferred}) {
        auto inputs = inputsFor(camera, kind);
        inputs.settings.shading = ShadingModel::kLambert;
        inputs.settings.lights.count = 0;
        const Picture picture = draw(renderer, inputs);
        double worst = 0;
        for (uint32_t y = 0; y < picture.height_px; ++y) {
            for (uint32_t x = 0; x < picture.width_px; ++x) {
                const auto point = floorAt(camera, inputs.settings.size, x, y);
                const double expected = irradianceOnFloor(scene, point) / std::numbers::pi;
                const size_t at = 3 * (size_t{y} * picture.width_px + x);
                for (size_t channel = 0; channel < 3; ++channel) {
                    const double color = 1.0 / static_cast<double>(1U << channel);
                    const double value = static_cast<double>(picture.radiance[at + channel]);
                    worst = std::max(worst, std::abs(value - expected * color) /
                                                (expected * color + 1e-4));
                }
            }
        }
        // The G-buffer's normal is up to 0.0036 degrees off.
        EXPECT_LT(worst, kind == Renderer::kClusteredDeferred ? 1e-3 : 2e-4) << nameOf(kind);
    }
}

namespace {

// Balls on a floor, 2.4 m from corner to corner, with lamps as near to them as 7 mm; all of it
// `scale` times as large, and lit as bright.
scene::Scene makeScaled(double scale) {
    const auto size = static_cast<float>(scale);
    scene::Material gloss = chalk();
    gloss.roughness = 0.4F;
    SceneMaker made;
    made.add(gloss);
    made.add(quad({-0.8F * size, 0, 0.8F * size}, {1.6F * size, 0, 0}, {0, 0, -1.6F * size}, 4, 0));
    glm::dmat4 at(1);
    for (const double x : {-0.4, 0.4}) {
        at[3] = glm::dvec4(x * scale, 0.3 * scale, 0, 1);
        made.add(sphere(0.3F * size, 12, 1), at);
    }
    const auto candela = static_cast<float>(scale * scale);
    made.point(glm::dvec3(0, 0.5, 0.3) * scale, 1.5F * size, candela);
    made.point(glm::dvec3(0.1, 0.007, 0.5) * scale, 0.5F * size, 0.01F * candela);
    made.point(glm::dvec3(-0.4, 0.609, 0) * scale, 0, 0.01F * candela);
    made.scene.cameras = {{"", settings::lookAt(glm::dvec3(0.3, 0.9, 1.6) * scale,
                                                glm::dvec3(0, 0.2, 0) * scale, {0, 1, 0})}};
    made.scene.cameras[0].camera.near_m = 0.01 * scale;
    return made.scene;
}

Picture drawScaled(gpu::Device& device, double scale, Renderer kind) {
    const auto scene = makeScaled(scale);
    auto inputs = inputsFor(scene.cameras[0].camera, kind);
    inputs.settings.lights.count = 0;
    inputs.settings.lights.ambient = 0.01F;
    render::Renderer renderer(device, scene);
    return draw(renderer, inputs);
}

} // namespace

// What a distance is compared with goes with the scene: a model of 2 cm is lit as the same in
// metres. By powers of two no digit changes, but by lists, whose clusters differ.
TEST_F(Shading, SceneAndLightsScaled_GiveTheSamePicture) {
    for (const auto kind : {Renderer::kNaive, Renderer::kClusteredDeferred}) {
        SCOPED_TRACE(nameOf(kind));
        const Picture whole = drawScaled(device(), 1, kind);
        for (const double scale : {0x1p-7, 0x1p10}) {
            EXPECT_EQ(differingFloats(whole, drawScaled(device(), scale, kind)), 0U) << scale;
        }
        for (const double scale : {0.01, 1000.0}) {
            const Picture scaled = drawScaled(device(), scale, kind);
            ASSERT_EQ(scaled.radiance.size(), whole.radiance.size());
            size_t off = 0;
            for (size_t i = 0; i < whole.radiance.size(); ++i) {
                const double expected = static_cast<double>(whole.radiance[i]);
                const double value = static_cast<double>(scaled.radiance[i]);
                off += std::abs(value - expected) > 0.002 * expected + 1e-5 ? 1U : 0U;
            }
            // Positions round otherwise: an edge may take another pixel.
            EXPECT_LE(off, 30U) << scale;
        }
    }
}

namespace {

void expectSameByAnyWay(render::Renderer& renderer, render::FrameInputs inputs) {
    inputs.settings.renderer = Renderer::kNaive;
    const Picture naive = draw(renderer, inputs);
    inputs.settings.renderer = Renderer::kForwardPlus;
    EXPECT_EQ(differingFloats(naive, draw(renderer, inputs)), 0U);
    for (const auto kind :
         {Renderer::kClusteredDeferred, Renderer::kToonFragment, Renderer::kToonCompute}) {
        SCOPED_TRACE(nameOf(kind));
        inputs.settings.renderer = kind;
        const Picture lists = draw(renderer, inputs);
        auto other = inputs;
        other.settings.light_loop = LightLoop::kAllLights;
        EXPECT_EQ(differingFloats(lists, draw(renderer, other)), 0U);
        other = inputs;
        other.settings.lighting = LightingStage::kFragment;
        EXPECT_EQ(differingFloats(lists, draw(renderer, other)), 0U);
    }
}

} // namespace

TEST_F(Shading, Lambert_ListsStagesAndRenderers_GiveTheSamePicture) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    for (const auto& camera : scene.cameras) {
        for (const uint32_t count : {1U, 40U, 700U}) {
            SCOPED_TRACE(count);
            auto inputs = inputsFor(camera.camera, Renderer::kNaive);
            inputs.settings.shading = ShadingModel::kLambert;
            inputs.settings.lights.count = count;
            expectSameByAnyWay(renderer, inputs);
        }
    }
}

TEST_F(Shading, BlinnPhong_ListsStagesAndRenderers_GiveTheSamePicture) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    auto inputs = inputsFor(scene.cameras[0].camera, Renderer::kNaive);
    inputs.settings.shading = ShadingModel::kBlinnPhong;
    inputs.settings.lights.count = 40;
    expectSameByAnyWay(renderer, inputs);
}

TEST_F(Shading, OtherModels_AgainstPbr_AreOtherPictures) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    auto inputs = inputsFor(scene.cameras[0].camera, Renderer::kClusteredDeferred);
    const Picture pbr = draw(renderer, inputs);
    for (const auto shading : {ShadingModel::kLambert, ShadingModel::kBlinnPhong}) {
        inputs.settings.shading = shading;
        EXPECT_GT(differingFloats(pbr, draw(renderer, inputs)), pbr.radiance.size() / 2);
    }
}

// A light of another radius, too far away to add anything, makes the radius no constant any more;
// a spot likewise brings in cones.
TEST_F(Shading, EqualRadiiAndNoSpots_AgainstTheGenericVariant_GiveTheSamePicture) {
    for (const auto type : {scene::LightType::kPoint, scene::LightType::kSpot}) {
        auto equal = makeRoom();
        addPoint(equal, {0, 1, 1}, 1.5F);
        auto mixed = equal;
        addPoint(mixed, {0, 1e6, 0}, 3);
        mixed.lights.back().type = type;
        render::Renderer equal_renderer(device(), equal);
        render::Renderer mixed_renderer(device(), mixed);
        for (const auto kind : {Renderer::kNaive, Renderer::kClusteredDeferred}) {
            for (const auto shading : {ShadingModel::kPbr, ShadingModel::kLambert}) {
                auto inputs = inputsFor(equal.cameras[0].camera, kind);
                inputs.settings.shading = shading;
                inputs.settings.lights.count = 150;
                inputs.settings.lights.radius_m = 1.5F;
                EXPECT_EQ(
                    differingFloats(draw(equal_renderer, inputs), draw(mixed_renderer, inputs)), 0U)
                    << nameOf(kind);
            }
        }
    }
}

// llvmpipe ends loops after 65,535 iterations: no light may be lost to that.
TEST_F(Shading, MoreLightsThanALoopHasIterations_AnyLoop_AddsThemAll) {
    const auto scene = makeFloor();
    std::vector<Picture> pictures;
    for (const bool subgroups : {true, false}) {
        gpu::DeviceOptions options;
        options.subgroups = subgroups;
        openDevice(options);
        render::Renderer renderer(device(), scene);
        for (const auto kind : {Renderer::kNaive, Renderer::kForwardPlus}) {
            auto inputs = inputsFor(settings::lookAt({0, 4, 1}, {0, 0, 0}, {0, 1, 0}), kind);
            inputs.settings.size = {16, 16};
            inputs.settings.shading = ShadingModel::kLambert;
            inputs.settings.lights.count = 70'000;
            inputs.settings.lights.radius_m = 0.5F;
            pictures.push_back(draw(renderer, inputs));
        }
    }
    for (const auto& picture : pictures) {
        EXPECT_EQ(differingFloats(pictures[0], picture), 0U);
    }
}

TEST_F(Shading, CountPairs_ListsOrAllLights_AgreeOnWhatContributes) {
    auto scene = makeRoom();
    addPoint(scene, {0, 1, 1}, 2);
    scene.lights.back().type = scene::LightType::kSpot;
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (const auto kind : {Renderer::kForwardPlus, Renderer::kClusteredDeferred}) {
        SCOPED_TRACE(nameOf(kind));
        auto inputs = inputsFor(scene.cameras[0].camera, kind);
        inputs.settings.lights.count = 99;
        EXPECT_FALSE(draw(view, inputs).stats.steps.find("pairs", "evaluated"));
        inputs.settings.count_pairs = true;
        const StepStats lists = draw(view, inputs).stats.steps;
        inputs.settings.light_loop = LightLoop::kAllLights;
        const StepStats all = draw(view, inputs).stats.steps;
        const uint64_t contributing = lists.count("pairs", "contributing");
        EXPECT_GT(contributing, 0U);
        EXPECT_EQ(contributing, all.count("pairs", "contributing"));
        EXPECT_LE(contributing, lists.count("pairs", "evaluated"));
        const uint64_t evaluated = all.count("pairs", "evaluated");
        EXPECT_LT(lists.count("pairs", "evaluated"), evaluated);
        EXPECT_EQ(evaluated % 100, 0U); // lights times pixels
        EXPECT_LE(evaluated, 100U * 96 * 54);
    }
}

TEST_F(Shading, CountPairs_NoLights_CountsNone) {
    const auto scene = makeFloor();
    render::Renderer renderer(device(), scene);
    auto inputs =
        inputsFor(settings::lookAt({0, 4, 1}, {0, 0, 0}, {0, 1, 0}), Renderer::kForwardPlus);
    inputs.settings.lights.count = 0;
    inputs.settings.count_pairs = true;
    const StepStats stats = draw(renderer, inputs).stats.steps;
    EXPECT_EQ(stats.find("pairs", "evaluated"), 0.0);
    EXPECT_EQ(stats.find("pairs", "contributing"), 0.0);
}

// What a frame counted is read by its own plan, though the view has gone on to the next one.
TEST_F(Shading, CountPairs_OfTwoFramesInFlight_AreEachItsOwn) {
    const auto scene = makeFloor();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs =
        inputsFor(settings::lookAt({0, 4, 1}, {0, 0, 0}, {0, 1, 0}), Renderer::kForwardPlus);
    inputs.settings.count_pairs = true;
    auto dark = inputs;
    dark.settings.lights.count = 0;
    dark.settings.lights.scene_lights = false;
    inputs.settings.lights.count = 30;
    inputs.settings.light_loop = LightLoop::kAllLights;
    ASSERT_TRUE(view.submit(dark));
    ASSERT_TRUE(view.submit(inputs));
    const auto of_dark = view.collect();
    ASSERT_TRUE(of_dark);
    EXPECT_EQ(of_dark->stats.steps.find("pairs", "evaluated"), 0.0);
    ASSERT_TRUE(view.submit(dark));
    const auto of_lit = view.collect();
    ASSERT_TRUE(of_lit);
    EXPECT_GT(of_lit->stats.steps.count("pairs", "evaluated"), 0U);
    ASSERT_TRUE(view.collect());
}

} // namespace froxel::test

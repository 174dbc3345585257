// Light from around on pictures: closed forms and symmetries, exactness, and what it takes. The
// reference in double is in reference_test.cpp.
#include "environment/surroundings.h"
#include "interface/constants.h"
#include "render/scene/scene_resources.h"
#include "settings/environment.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/shapes.h"
#include "support/test_scenes.h"
#include "support/tier.h"
#include "unit/environment/axes.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <thread>

namespace froxel::test {

namespace {

using settings::EnvironmentLight;
using settings::Renderer;
using settings::ShadingModel;
using ::testing::Contains;
using ::testing::Key;
using ::testing::Not;

class Environment : public GpuTest {
  protected:
    [[nodiscard]] std::map<std::string, uint64_t> memory() {
        return device().memoryLedger()->byPurpose();
    }
};

// Roughness 0 to 1 to the right, metalness 0 to 1 upwards.
scene::Scene makeSpheres(const glm::vec4& base_color) {
    SceneMaker maker;
    for (int x = 0; x < 5; ++x) {
        for (int y = 0; y < 3; ++y) {
            scene::Material material;
            material.base_color = base_color;
            material.roughness = static_cast<float>(x) / 4;
            material.metallic = static_cast<float>(y) / 2;
            const glm::dmat4 placed = glm::translate(glm::dmat4(1), glm::dvec3(x - 2, y - 1, 0));
            maker.add(sphere(0.45F, 24, maker.add(material)), placed);
        }
    }
    return maker.scene;
}

render::FrameInputs inputsFor(Renderer renderer, EnvironmentLight light) {
    render::FrameInputs inputs;
    inputs.settings.camera = settings::lookAt({0.3, 0.5, 4.5}, {0, 0, 0}, {0, 1, 0});
    inputs.settings.size = {120, 72};
    inputs.settings.renderer = renderer;
    inputs.settings.lights.count = 0;
    inputs.settings.environment.light = light;
    return inputs;
}

std::shared_ptr<const environment::Surroundings> surroundingsOf(LinearImage panorama) {
    return std::make_shared<const environment::Surroundings>(
        environment::surroundingsOf(std::move(panorama)));
}

// Bright ahead and to the right, nowhere sharp.
glm::dvec3 softSky(const glm::dvec3& direction) {
    return glm::dvec3(1) + glm::dvec3(0.6, 0.2, 0.1) * direction.x +
           glm::dvec3(0.1, 0.5, 0.2) * direction.z + glm::dvec3(0.3) * (direction.x * direction.y);
}

// As one that is turned by a quarter: what was ahead, at +Z, comes to +X.
LinearImage quarterTurned(const LinearImage& panorama) {
    LinearImage turned = panorama;
    const size_t width = panorama.width_px;
    for (size_t y = 0; y < panorama.height_px; ++y) {
        for (size_t x = 0; x < width; ++x) {
            const size_t from = y * width + (x + width / 4) % width;
            std::copy_n(&panorama.rgb[3 * from], 3, &turned.rgb[3 * (y * width + x)]);
        }
    }
    return turned;
}

double mostDifference(const Picture& a, const Picture& b) {
    double most = 0;
    for (size_t i = 0; i < a.radiance.size(); ++i) {
        most = std::max(most, std::abs(static_cast<double>(a.radiance[i] - b.radiance[i])));
    }
    return most;
}

} // namespace

// White surfaces send all that they get, so nothing tells them from what is around.
TEST_F(Environment, WhiteFurnace_EverySphereVanishes) {
    const glm::dvec3 sky(0.5, 1, 2);
    auto scene = makeSpheres({1, 1, 1, 1});
    scene.surroundings =
        surroundingsOf(environment::panoramaOf(8, [&](const glm::dvec3&) { return sky; }));
    render::Renderer renderer(device(), scene);
    for (const auto kind :
         {Renderer::kNaive, Renderer::kClusteredDeferred, Renderer::kToonFragment}) {
        for (const auto model :
             {ShadingModel::kPbr, ShadingModel::kLambert, ShadingModel::kBlinnPhong}) {
            auto inputs = inputsFor(kind, EnvironmentLight::kFile);
            inputs.settings.shading = model;
            const Picture picture = draw(renderer, inputs);
            size_t covered = 0;
            for (size_t i = 0; i < picture.radiance.size(); ++i) {
                const auto channel = static_cast<glm::length_t>(i % 3);
                if (picture.radiance[i] == 0) {
                    continue;
                }
                ++covered;
                ASSERT_NEAR(static_cast<double>(picture.radiance[i]), sky[channel], 1e-5)
                    << "pixel " << i / 3 << " of " << settings::kRendererNames[size_t(kind)];
            }
            EXPECT_GT(covered, 3U * 120 * 72 / 5);
        }
    }
}

// A white surface sends what its coat does not take, and of that the coat returns its lobe's
// albedo: where it is smooth all but at grazing angles, where it is roughest 1 - u ln(1 + 1 / u),
// u = n.v. What is lost is most at u = 0.115, and 0.04 ln 2 in the middle of the picture.
TEST_F(Environment, WhiteFurnace_CoatsLoseWhatTheirLobesLose) {
    for (const float roughness : {0.0F, 1.0F}) {
        auto scene = makeSpheres({1, 1, 1, 1});
        for (auto& material : scene.materials) {
            material.coat.strength = 1;
            material.coat.roughness = roughness;
        }
        scene.surroundings = surroundingsOf(
            environment::panoramaOf(8, [](const glm::dvec3&) { return glm::dvec3(1); }));
        render::Renderer renderer(device(), scene);
        for (const auto kind : {Renderer::kForwardPlus, Renderer::kClusteredDeferred}) {
            const Picture picture = draw(renderer, inputsFor(kind, EnvironmentLight::kFile));
            std::vector<double> seen;
            for (size_t i = 0; i < picture.radiance.size(); i += 3) {
                if (picture.radiance[i] != 0) {
                    seen.push_back(static_cast<double>(picture.radiance[i]));
                }
            }
            const auto middle = static_cast<double>(picture.radiance[3 * (36 * 120 + 60)]);
            EXPECT_GT(seen.size(), 120U * 72 / 5);
            EXPECT_LT(*std::ranges::max_element(seen), 1 + 1e-5);
            std::ranges::sort(seen);
            if (roughness == 0) {
                EXPECT_NEAR(middle, 1, 1e-4);
                EXPECT_GT(seen[seen.size() / 20], 0.999);
            } else {
                EXPECT_NEAR(middle, 1 - 0.04 * std::log(2), 1e-3);
                EXPECT_NEAR(seen.front(), 0.8534, 2e-3);
            }
        }
    }
}

namespace {

// In surroundings that are white and even, all that is drawn is between the two.
void expectFurnace(gpu::Device& device, scene::Scene scene, double least, double most) {
    scene.surroundings =
        surroundingsOf(environment::panoramaOf(8, [](const glm::dvec3&) { return glm::dvec3(1); }));
    render::Renderer renderer(device, scene);
    for (const auto kind : {Renderer::kForwardPlus, Renderer::kClusteredDeferred}) {
        const Picture picture = draw(renderer, inputsFor(kind, EnvironmentLight::kFile));
        size_t covered = 0;
        for (const float seen : picture.radiance) {
            if (seen != 0) {
                ++covered;
                ASSERT_LT(static_cast<double>(seen), most);
                ASSERT_GT(static_cast<double>(seen), least);
            }
        }
        EXPECT_GT(covered, 3U * 120 * 72 / 5);
    }
}

} // namespace

// Fibres return what they keep from a white surface, whatever their roughness.
TEST_F(Environment, WhiteFurnace_SheenLosesNothing) {
    for (const float roughness : {0.0F, 0.4F, 1.0F}) {
        auto scene = makeSpheres({1, 1, 1, 1});
        for (auto& material : scene.materials) {
            material.sheen = {.color = glm::vec3(0.9F), .roughness = roughness};
        }
        expectFurnace(device(), scene, 1 - 1e-5, 1 + 1e-5);
    }
}

// All at once: a coat over fibres over a film over what lets half of it through. White keeps
// nothing, but what a coat, fibres and a film take once and do not give back.
TEST_F(Environment, WhiteFurnace_AllLayersTogetherGiveNoMoreThanTheyTake) {
    auto scene = makeSpheres({1, 1, 1, 1});
    for (auto& material : scene.materials) {
        material.diffuse_transmission.strength = 0.5F;
        material.roughness = 0.3F;
    }
    expectFurnace(device(), scene, 1 - 1e-5, 1 + 1e-5);
    for (auto& material : scene.materials) {
        material.sheen = {.color = glm::vec3(0.7F), .roughness = 0.5F};
        material.film = {.strength = 0.8F};
        material.anisotropy = {.strength = 0.6F};
        material.coat = {.strength = 1};
    }
    expectFurnace(device(), scene, 0.9, 1 + 1e-5);
}

// Samples of a lobe lie at other angles about its normal: 0.01 of up to 2.5.
TEST_F(Environment, Rotation_IsThatOfThePanorama) {
    const auto panorama = environment::panoramaOf(64, softSky);
    auto scene = makeSpheres({0.9F, 0.7F, 0.5F, 1});
    scene.surroundings = surroundingsOf(panorama);
    auto turned_scene = scene;
    turned_scene.surroundings = surroundingsOf(quarterTurned(panorama));
    render::Renderer renderer(device(), scene);
    render::Renderer turned_renderer(device(), turned_scene);
    for (const auto kind : {Renderer::kForwardPlus, Renderer::kClusteredDeferred}) {
        auto inputs = inputsFor(kind, EnvironmentLight::kFile);
        const Picture expected = draw(turned_renderer, inputs);
        EXPECT_GT(mostDifference(expected, draw(renderer, inputs)), 0.3);
        inputs.settings.environment.rotation_deg = 90;
        EXPECT_LT(mostDifference(expected, draw(renderer, inputs)), 0.02);
    }
}

TEST_F(Environment, Strength_IsAFactor) {
    const auto scene = makeSpheres({0.9F, 0.7F, 0.5F, 1});
    render::Renderer renderer(device(), scene);
    for (const auto kind : {Renderer::kForwardPlus, Renderer::kClusteredDeferred}) {
        auto inputs = inputsFor(kind, EnvironmentLight::kStudio);
        const Picture once = draw(renderer, inputs);
        inputs.settings.environment.strength = 2;
        const Picture twice = draw(renderer, inputs);
        for (size_t i = 0; i < once.radiance.size(); ++i) {
            if (once.radiance[i] != 0) {
                ASSERT_EQ(twice.radiance[i], 2 * once.radiance[i]);
            }
        }
        inputs.settings.environment.strength = 0;
        const Picture none = draw(renderer, inputs);
        EXPECT_EQ(*std::ranges::min_element(none.radiance), 0.0F);
    }
}

TEST_F(Environment, Ambient_GivesWay) {
    const auto scene = makeSpheres({0.9F, 0.7F, 0.5F, 1});
    render::Renderer renderer(device(), scene);
    auto inputs = inputsFor(Renderer::kForwardPlus, EnvironmentLight::kStudio);
    const Picture usual = draw(renderer, inputs);
    inputs.settings.lights.ambient = 50;
    EXPECT_EQ(differingFloats(usual, draw(renderer, inputs)), 0U);
}

TEST_F(Environment, Renderers_WithLists_EqualAllLightsBitForBit) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    for (const auto model :
         {ShadingModel::kPbr, ShadingModel::kLambert, ShadingModel::kBlinnPhong}) {
        auto inputs = inputsFor(Renderer::kNaive, EnvironmentLight::kStudio);
        inputs.settings.camera = scene.cameras[0].camera;
        inputs.settings.shading = model;
        inputs.settings.lights.count = 100;
        inputs.settings.light_loop = settings::LightLoop::kLists;
        const Picture naive = draw(renderer, inputs);
        inputs.settings.renderer = Renderer::kForwardPlus;
        EXPECT_EQ(differingFloats(naive, draw(renderer, inputs)), 0U);
        for (const auto kind :
             {Renderer::kClusteredDeferred, Renderer::kToonFragment, Renderer::kToonCompute}) {
            inputs.settings.renderer = kind;
            const Picture lists = draw(renderer, inputs);
            auto all = inputs;
            all.settings.light_loop = settings::LightLoop::kAllLights;
            EXPECT_EQ(differingFloats(lists, draw(renderer, all)), 0U);
            if (model != ShadingModel::kPbr && !wholeGrids()) {
                continue;
            }
            auto fragment = inputs;
            fragment.settings.lighting = settings::LightingStage::kFragment;
            EXPECT_EQ(differingFloats(lists, draw(renderer, fragment)), 0U);
        }
    }
}

// Most of the picture is empty.
TEST_F(Environment, StagesOfLighting_AndEmptyPixels_AreTheSameBits) {
    const auto scene = makeSpheres({0.9F, 0.7F, 0.5F, 1});
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (const auto kind :
         {Renderer::kClusteredDeferred, Renderer::kToonFragment, Renderer::kToonCompute}) {
        for (const auto mode : {settings::ExposureMode::kFixed, settings::ExposureMode::kFrame}) {
            auto inputs = inputsFor(kind, EnvironmentLight::kStudio);
            inputs.settings.exposure_mode = mode;
            inputs.settings.background.color = {0.25F, 0.5F, 1};
            inputs.settings.lighting = settings::LightingStage::kCompute;
            const Picture compute = draw(renderer, inputs);
            const Picture compute_pixels = drawPixels(view, inputs);
            for (const auto stage :
                 {settings::LightingStage::kAuto, settings::LightingStage::kFragment}) {
                inputs.settings.lighting = stage;
                EXPECT_EQ(differingFloats(compute, draw(renderer, inputs)), 0U);
                EXPECT_EQ(compute_pixels.rgba8, drawPixels(view, inputs).rgba8);
            }
        }
    }
}

// Behind spheres, and behind nothing: what a mirror of its roughness would show. Every renderer
// shows the same.
TEST_F(Environment, Background_IsThatOfEveryRenderer) {
    const auto scene = makeSpheres({0.9F, 0.7F, 0.5F, 1});
    render::Renderer renderer(device(), scene);
    auto inputs = inputsFor(Renderer::kNaive, EnvironmentLight::kStudio);
    inputs.settings.environment.rotation_deg = 25;
    const auto isEmpty = [](const Picture& without, size_t pixel) {
        return without.radiance[3 * pixel] == 0;
    };
    const Picture without = draw(renderer, inputs);
    inputs.settings.environment.background = true;
    const Picture naive = draw(renderer, inputs);
    for (size_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
        inputs.settings.renderer = static_cast<Renderer>(kind);
        const Picture picture = draw(renderer, inputs);
        size_t empty = 0;
        for (size_t i = 0; i < picture.radiance.size() / 3; ++i) {
            if (isEmpty(without, i)) {
                ++empty;
                ASSERT_TRUE(std::equal(&naive.radiance[3 * i], &naive.radiance[3 * i] + 3,
                                       &picture.radiance[3 * i]));
                ASSERT_GT(picture.radiance[3 * i], 0.05F); // nothing there is as dark as before
            } else if (kind == 0) {
                ASSERT_EQ(picture.radiance[3 * i], without.radiance[3 * i]);
            }
        }
        EXPECT_GT(empty, 120U * 72 / 4);
    }
}

// Rays that are parallel all see what is ahead.
TEST_F(Environment, BackgroundOfAnOrthographicCamera_IsWhatIsAhead) {
    const scene::Scene nothing;
    render::Renderer renderer(device(), nothing);
    const auto ahead = [&](const glm::dvec3& target, bool orthographic) {
        auto inputs = inputsFor(Renderer::kForwardPlus, EnvironmentLight::kStudio);
        inputs.settings.environment.background = true;
        inputs.settings.camera = settings::lookAt({0, 0, 0}, target, {0, 1, 0});
        if (orthographic) {
            inputs.settings.camera.projection = settings::Projection::kOrthographic;
            inputs.settings.camera.half_height_m = 1;
        } else {
            inputs.settings.camera.yfov_rad = glm::radians(0.1);
        }
        return draw(renderer, inputs).radiance;
    };
    for (const glm::dvec3& target : {glm::dvec3(0, 0.9, -1), glm::dvec3(0, -0.9, 1)}) {
        const auto narrow = ahead(target, false);
        const auto parallel = ahead(target, true);
        const auto behind = ahead(-target, false);
        EXPECT_GT(std::abs(narrow[0] - behind[0]), 0.1F * narrow[0]) << "they can be told apart";
        for (size_t i = 0; i < parallel.size(); ++i) {
            ASSERT_NEAR(parallel[i], narrow[i], 0.02F * narrow[i]);
        }
    }
}

TEST_F(Environment, Off_HasNothingOfIt) {
    const auto scene = makeSpheres({1, 1, 1, 1});
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(Renderer::kForwardPlus, EnvironmentLight::kOff);
    const auto lit = [&] {
        return std::ranges::any_of(
            renderer.resources().shared.variantsMade(),
            [](const auto& made) { return (made.key.light_flags & io::kLightEnvironment) != 0; });
    };
    inputs.settings.environment.strength = 3; // of nothing
    const Picture before = drawPixels(view, inputs);
    EXPECT_FALSE(lit());
    EXPECT_THAT(memory(), Not(Contains(Key("environment levels"))));
    EXPECT_THAT(memory(), Not(Contains(Key("environment lobes"))));
    inputs.settings.environment.light = EnvironmentLight::kStudio;
    EXPECT_NE(drawPixels(view, inputs).rgba8, before.rgba8);
    EXPECT_TRUE(lit());
    EXPECT_THAT(memory(), Contains(Key("environment levels")));
    inputs.settings.environment.light = EnvironmentLight::kOff;
    EXPECT_EQ(drawPixels(view, inputs).rgba8, before.rgba8);
}

TEST_F(Environment, DebugViewInThePicturesPlace_ShowsTheSame) {
    const auto scene = makeSpheres({0.9F, 0.7F, 0.5F, 1});
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(Renderer::kClusteredDeferred, EnvironmentLight::kOff);
    inputs.settings.debug.view = settings::DebugView::kBaseColor;
    const Picture without = drawPixels(view, inputs);
    inputs.settings.environment.light = EnvironmentLight::kStudio;
    EXPECT_EQ(drawPixels(view, inputs).rgba8, without.rgba8);
}

TEST_F(Environment, FileThatTheServerLacks_IsRefused) {
    const auto scene = makeSpheres({1, 1, 1, 1});
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    const auto refused = view.submit(inputsFor(Renderer::kForwardPlus, EnvironmentLight::kFile));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kUnsupported);
    EXPECT_EQ(refused.error().message,
              "environment is file, but no --environment-file was given; use studio or off");
    EXPECT_TRUE(view.submit(inputsFor(Renderer::kForwardPlus, EnvironmentLight::kStudio)));
    EXPECT_TRUE(view.collect());
}

TEST_F(Environment, MemoryThatIsNotThere_IsRefusedBeforeItIsTaken) {
    const auto scene = makeSpheres({1, 1, 1, 1});
    const uint64_t scene_bytes = [&] {
        return render::Renderer(device(), scene).resources().shared.memory.takenBytes();
    }();
    render::Renderer renderer(device(), scene, {.device_bytes = scene_bytes + (1U << 20U)});
    render::ViewRenderer view(renderer);
    const auto refused = view.submit(inputsFor(Renderer::kForwardPlus, EnvironmentLight::kStudio));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kCapacity);
    EXPECT_THAT(refused.error().message, testing::HasSubstr("light from around takes 3 MiB"));
    EXPECT_THAT(memory(), Not(Contains(Key("environment levels"))));
}

// Whoever asks first does not wait in begin().
TEST_F(Environment, MadeAside_GivesTheSamePicture) {
    const auto scene = makeSpheres({0.9F, 0.7F, 0.5F, 1});
    const auto inputs = inputsFor(Renderer::kClusteredDeferred, EnvironmentLight::kStudio);
    render::Renderer at_once(device(), scene);
    render::ViewRenderer expected(at_once);
    render::RenderDevice on(device());
    on.makeVariantsInBackground(0, 1);
    render::Renderer renderer(on, scene);
    render::ViewRenderer view(renderer);
    auto work = view.begin(inputs);
    ASSERT_TRUE(work) << work.error().message;
    EXPECT_EQ(work->piece_count, 0U);
    while (work && work->piece_count == 0) {
        std::this_thread::yield();
        work = view.begin(inputs);
    }
    ASSERT_TRUE(work) << work.error().message;
    for (uint32_t i = 0; i < work->piece_count; ++i) {
        ASSERT_TRUE(view.submitPiece());
    }
    const auto drawn = view.collect();
    ASSERT_TRUE(drawn);
    const PixelView& pixels = drawn->pixels.view();
    const Picture meant = drawPixels(expected, inputs);
    EXPECT_TRUE(std::equal(meant.rgba8.begin(), meant.rgba8.end(), pixels.data));
}

} // namespace froxel::test

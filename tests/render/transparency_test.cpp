// Ways of transparency against layers composed in double, and what a frame has for them.
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/shapes.h"
#include "support/test_scenes.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace froxel::test {

namespace {

using settings::Renderer;
using settings::Transparency;
using ::testing::Contains;
using ::testing::Key;
using ::testing::Not;

class TransparencyTest : public SharedGpuTest {};

constexpr settings::Size kSize{96, 54};

render::FrameInputs inputsFor(Transparency transparency, uint32_t layers = 16) {
    render::FrameInputs inputs;
    inputs.settings.size = kSize;
    inputs.settings.renderer = Renderer::kForwardPlus;
    inputs.settings.transparency = transparency;
    inputs.settings.tone_map =
        settings::ToneMap::kClamp; // unlit panes send their colours as they are
    inputs.settings.peel_layers = layers;
    inputs.settings.lights.count = 40;
    inputs.time_s = 1.5;
    return inputs;
}

scene::Material tint(const glm::vec4& color) {
    scene::Material material = chalk();
    material.base_color = color;
    material.alpha_mode = scene::AlphaMode::kBlend;
    material.double_sided = true;
    material.unlit = true;
    return material;
}

// A tilted pane without an edge in sight: the plane dot(normal, p) = dot(normal, (0, 0, z)).
struct Pane {
    double z;
    glm::dvec3 normal;
    glm::vec4 color;
};

scene::Primitive quadOf(const Pane& pane, uint32_t material) {
    const glm::dvec3 u = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), pane.normal));
    const glm::dvec3 v = glm::cross(pane.normal, u);
    const glm::dvec3 corner = glm::dvec3(0, 0, pane.z) - 20.0 * (u + v);
    return quad(corner, 40.0 * u, 40.0 * v, 1, material);
}

// Panes that cross each other all over the picture, before a wall of one colour.
struct Crossing {
    std::vector<Pane> panes;
    scene::Scene scene;
    glm::vec4 wall{0.2F, 0.3F, 0.1F, 1};
    static constexpr double kWall_m = 60;
};

Crossing crossingPanes(int count, bool reversed = false) {
    Crossing made;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> share(0.0F, 1.0F);
    const auto next = [&] { return static_cast<double>(share(random)); };
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 normal =
            glm::normalize(glm::dvec3(0.9 * next() - 0.45, 0.9 * next() - 0.45, 1));
        made.panes.push_back(
            {-2 - 4 * next(),
             normal,
             {share(random), share(random), share(random), 0.15F + 0.6F * share(random)}});
    }
    if (reversed) {
        std::reverse(made.panes.begin(), made.panes.end());
    }
    scene::Material wall = chalk();
    wall.base_color = made.wall;
    wall.unlit = true;
    SceneMaker maker(wall);
    const float far = Crossing::kWall_m;
    maker.add(quad({-200, -200, -far}, {400, 0, 0}, {0, 400, 0}, 1, 0));
    for (const Pane& pane : made.panes) {
        maker.add(quadOf(pane, maker.add(tint(pane.color))));
    }
    made.scene = std::move(maker.scene);
    return made;
}

struct Composed {
    glm::dvec3 color;
    double gap_m; // least distance between two layers
};

// From far to near, in double.
Composed
composed(const Crossing& crossing, const settings::Camera& camera, uint32_t x, uint32_t y) {
    const double half_y = std::tan(camera.yfov_rad / 2);
    const glm::dvec3 ray(((x + 0.5) / kSize.width_px * 2 - 1) * half_y * kSize.width_px /
                             kSize.height_px,
                         (1 - (y + 0.5) / kSize.height_px * 2) * half_y, -1);
    std::vector<std::pair<double, glm::dvec4>> layers;
    for (const Pane& pane : crossing.panes) {
        const double distance = pane.z * pane.normal.z / glm::dot(ray, pane.normal);
        if (distance > camera.near_m && distance < Crossing::kWall_m) {
            layers.emplace_back(distance, glm::dvec4(pane.color));
        }
    }
    std::sort(layers.begin(), layers.end(),
              [](const auto& a, const auto& b) { return a.first > b.first; });
    Composed all{glm::dvec3(glm::vec3(crossing.wall)), 1e9};
    for (size_t i = 0; i < layers.size(); ++i) {
        all.color = glm::mix(all.color, glm::dvec3(layers[i].second), layers[i].second.w);
        if (i > 0) {
            all.gap_m = std::min(all.gap_m, layers[i - 1].first - layers[i].first);
        }
    }
    return all;
}

struct Errors {
    double max = 0;
    double rmse = 0;
    size_t pixel_count = 0;
};

// At pixels whose layers are further apart than depth's rounding and the snapping of corners.
Errors errorsOf(const Picture& picture, const Crossing& crossing, const settings::Camera& camera) {
    Errors errors;
    for (uint32_t y = 0; y < kSize.height_px; ++y) {
        for (uint32_t x = 0; x < kSize.width_px; ++x) {
            const Composed right = composed(crossing, camera, x, y);
            if (right.gap_m < 0.01) {
                continue;
            }
            ++errors.pixel_count;
            for (int c = 0; c < 3; ++c) {
                const size_t i = 3 * (size_t{y} * kSize.width_px + x) + static_cast<size_t>(c);
                const double error =
                    std::abs(static_cast<double>(picture.radiance[i]) - right.color[c]);
                errors.max = std::max(errors.max, error);
                errors.rmse += error * error;
            }
        }
    }
    errors.rmse = std::sqrt(errors.rmse / (3 * static_cast<double>(errors.pixel_count)));
    return errors;
}

} // namespace

// Twelve panes that all cross: no order of instances is right anywhere. fp32 adds 12 roundings.
TEST_F(TransparencyTest, Peeled_CrossingPanes_AreAsSortedInDouble) {
    const auto crossing = crossingPanes(12);
    render::Renderer renderer(device(), crossing.scene);
    for (const auto kind : {Renderer::kNaive, Renderer::kForwardPlus}) {
        auto inputs = inputsFor(Transparency::kPeeled);
        inputs.settings.renderer = kind;
        const Picture picture = draw(renderer, inputs);
        const auto errors = errorsOf(picture, crossing, inputs.settings.camera);
        EXPECT_GT(errors.pixel_count, size_t{kSize.width_px} * kSize.height_px / 2);
        EXPECT_LT(errors.max, 2e-6);
        EXPECT_EQ(picture.stats.steps.count("peel", "overflow_pixels"), 0U);
    }
}

// Behind a G-buffer the wall has its 8 bits; the layers are as exact.
TEST_F(TransparencyTest, Peeled_OverEveryRenderer_IsTheSameLayers) {
    const auto crossing = crossingPanes(6);
    render::Renderer renderer(device(), crossing.scene);
    for (size_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
        for (const auto stage :
             {settings::LightingStage::kFragment, settings::LightingStage::kCompute}) {
            auto inputs = inputsFor(Transparency::kPeeled);
            inputs.settings.renderer = static_cast<Renderer>(kind);
            inputs.settings.lighting = stage;
            const Picture picture = draw(renderer, inputs);
            const bool toon = inputs.settings.renderer == Renderer::kToonCompute; // ramps the wall
            EXPECT_LT(errorsOf(picture, crossing, inputs.settings.camera).rmse, toon ? 0.2 : 0.003)
                << settings::kRendererNames[kind];
        }
    }
}

TEST_F(TransparencyTest, SortedAndWeighted_CrossingPanes_HaveTheErrorThatPeelingHasNot) {
    const auto crossing = crossingPanes(12);
    render::Renderer renderer(device(), crossing.scene);
    const auto rmse = [&](Transparency transparency, uint32_t layers) {
        const auto inputs = inputsFor(transparency, layers);
        return errorsOf(draw(renderer, inputs), crossing, inputs.settings.camera).rmse;
    };
    EXPECT_GT(rmse(Transparency::kSorted, 1), 0.02);
    EXPECT_GT(rmse(Transparency::kWeighted, 1), 0.005);
    EXPECT_LT(rmse(Transparency::kWeighted, 1), 0.2);
    // Each layer more is nearer to the whole.
    double before = 1;
    for (const uint32_t layers : {1U, 2U, 4U, 8U, 12U}) {
        const double now = rmse(Transparency::kPeeled, layers);
        EXPECT_LT(now, before) << layers;
        before = now;
    }
}

TEST_F(TransparencyTest, OrderOfTheScene_ChangesNeitherPeeledNorWeighted) {
    const auto forth = crossingPanes(8);
    const auto back = crossingPanes(8, true);
    render::Renderer renderer(device(), forth.scene);
    render::Renderer reversed(device(), back.scene);
    for (const auto transparency : {Transparency::kPeeled, Transparency::kWeighted}) {
        const auto inputs = inputsFor(transparency);
        const Picture a = draw(renderer, inputs);
        const Picture b = draw(reversed, inputs);
        size_t differing = 0;
        for (size_t i = 0; i < a.radiance.size(); ++i) {
            differing += std::abs(a.radiance[i] - b.radiance[i]) > 2e-6F ? 1U : 0U;
        }
        // Where two panes have equal depths, the later one is in front.
        EXPECT_LE(differing, transparency == Transparency::kPeeled ? 30U : 0U);
    }
}

// Of one lit layer all three are the same; sorting and peeling, bit for bit.
TEST_F(TransparencyTest, OneLayer_IsTheSameInEveryWay) {
    auto scene = makeRoom();
    scene.instances.erase(scene.instances.begin() + 4); // the second pane
    render::Renderer renderer(device(), scene);
    for (size_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
        auto inputs = inputsFor(Transparency::kSorted);
        inputs.settings.camera = scene.cameras[0].camera;
        inputs.settings.renderer = static_cast<Renderer>(kind);
        const Picture sorted = draw(renderer, inputs);
        inputs.settings.transparency = Transparency::kPeeled;
        EXPECT_EQ(differingFloats(sorted, draw(renderer, inputs)), 0U);
        inputs.settings.transparency = Transparency::kWeighted;
        const Picture weighted = draw(renderer, inputs);
        for (size_t i = 0; i < sorted.radiance.size(); ++i) {
            ASSERT_NEAR(weighted.radiance[i], sorted.radiance[i], 1e-5F * (1 + sorted.radiance[i]));
        }
    }
}

// The forward contract holds for layers: lists are all lights, bit for bit.
TEST_F(TransparencyTest, Lists_InEveryWay_AreAllLights) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    for (const auto transparency : {Transparency::kWeighted, Transparency::kPeeled}) {
        auto inputs = inputsFor(transparency);
        inputs.settings.camera = scene.cameras[1].camera;
        inputs.settings.light_loop = settings::LightLoop::kLists;
        const Picture lists = draw(renderer, inputs);
        inputs.settings.renderer = Renderer::kNaive;
        EXPECT_EQ(differingFloats(lists, draw(renderer, inputs)), 0U);
    }
}

// Ids and, where the device has what it takes, depths rastered in compute stand in for the solid
// surfaces' depth.
TEST_F(TransparencyTest, SolidSurfacesByIds_HideTheSameLayers) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    for (const auto transparency :
         {Transparency::kSorted, Transparency::kWeighted, Transparency::kPeeled}) {
        auto inputs = inputsFor(transparency);
        inputs.settings.renderer = Renderer::kClusteredDeferred;
        inputs.settings.camera = scene.cameras[0].camera;
        inputs.geometry = render::GeometryPath::kRaster;
        const Picture raster = draw(renderer, inputs);
        inputs.geometry = render::GeometryPath::kVisibility;
        const Picture ids = draw(renderer, inputs);
        size_t differing = 0;
        for (size_t i = 0; i < raster.radiance.size(); ++i) {
            differing += std::abs(raster.radiance[i] - ids.radiance[i]) > 0.02F ? 1U : 0U;
        }
        EXPECT_LT(differing, raster.radiance.size() / 50);
    }
}

TEST_F(TransparencyTest, WhatAFrameDoesNotBlend_HasNeitherPassNorMemory) {
    const auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    const auto memory = [] { return device().memoryLedger()->byPurpose(); };
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(Transparency::kPeeled, 2);
    inputs.settings.camera = scene.cameras[0].camera;
    const Picture peeled = draw(view, inputs);
    EXPECT_TRUE(hasPass(peeled, "peel") && hasPass(peeled, "peel_count") &&
                hasPass(peeled, "blend_resolve"));
    EXPECT_FALSE(hasPass(peeled, "transparent"));
    EXPECT_THAT(memory(), Contains(Key("peeled layer keys")));
    inputs.settings.transparency = Transparency::kWeighted;
    const Picture weighted = draw(view, inputs);
    EXPECT_TRUE(hasPass(weighted, "weighted") && hasPass(weighted, "blend_resolve"));
    EXPECT_FALSE(hasPass(weighted, "peel"));
    for (int i = 0; i < 3; ++i) { // frames in flight keep theirs
        (void)draw(view, inputs);
    }
    EXPECT_THAT(memory(), Contains(Key("blend weights")));
    EXPECT_THAT(memory(), Not(Contains(Key("peeled layer keys"))));
    inputs.settings.transparency = Transparency::kPeeled;
    inputs.settings.camera =
        settings::lookAt({0, 1, 9}, {0, 1, 12}, {0, 1, 0}); // away from the panes
    for (int i = 0; i < 3; ++i) {
        const Picture none = draw(view, inputs);
        EXPECT_FALSE(hasPass(none, "peel") || hasPass(none, "blend_resolve"));
        EXPECT_EQ(none.stats.steps.count("peel", "layers"), 0U);
    }
    EXPECT_THAT(memory(), Not(Contains(Key("blended sums"))));
}

// Four samples, bloom and lines over it take the layers as they take the sorted ones.
TEST_F(TransparencyTest, WithOtherPasses_OneLayerIsAsSorted) {
    auto scene = makeRoom();
    scene.instances.erase(scene.instances.begin() + 4);
    render::Renderer renderer(device(), scene);
    auto inputs = inputsFor(Transparency::kSorted);
    inputs.settings.camera = scene.cameras[0].camera;
    inputs.settings.renderer = Renderer::kClusteredDeferred;
    inputs.settings.antialiasing = settings::Antialiasing::kSsaa4;
    inputs.settings.bloom.kind = settings::BloomKind::kMipChain;
    inputs.settings.debug.view = settings::DebugView::kClusterWires;
    const Picture sorted = draw(renderer, inputs);
    inputs.settings.transparency = Transparency::kPeeled;
    EXPECT_EQ(differingFloats(sorted, draw(renderer, inputs)), 0U);
}

// Through the neutral tone map and any exposure: dark channels, bright ones and those between.
TEST_F(TransparencyTest, UnlitPanes_ThatCoverAll_HaveTheirOwnColours) {
    for (const glm::vec4& color :
         {glm::vec4(0.5F, 0, 0, 1), glm::vec4(0.02F, 0.3F, 0.1F, 1), glm::vec4(0.2F, 0.2F, 0.2F, 1),
          glm::vec4(0.9F, 0.8F, 0.1F, 1), glm::vec4(0.039F, 0.041F, 0.7F, 1)}) {
        SceneMaker maker(tint(color));
        maker.add(quadOf({-3, {0, 0, 1}, {}}, 0));
        render::Renderer renderer(device(), maker.scene);
        auto inputs = inputsFor(Transparency::kSorted);
        inputs.settings.tone_map = settings::ToneMap::kPbrNeutral;
        inputs.settings.exposure = 2.5F;
        const Picture picture = draw(renderer, inputs);
        const size_t middle = 4 * (size_t{27} * kSize.width_px + 48);
        for (size_t channel = 0; channel < 3; ++channel) {
            const auto linear = static_cast<double>(color[static_cast<int>(channel)]);
            const double encoded =
                linear < 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
            EXPECT_NEAR(std::to_integer<int>(picture.rgba8[middle + channel]), 255 * encoded, 1)
                << color.x << " " << color.y << " " << color.z << ", channel " << channel;
        }
    }
}

// A black label of 3/4 on a white wall, neither lit: a quarter of the display's white, 137 in sRGB.
TEST_F(TransparencyTest, AnUnlitLabelOnAnUnlitWall_IsAQuarterOfWhite_WhateverTheExposure) {
    scene::Material wall = chalk();
    wall.base_color = glm::vec4(1);
    wall.unlit = true;
    SceneMaker maker(wall);
    maker.add(quad({-20, -20, -6}, {40, 0, 0}, {0, 40, 0}, 1, 0));
    maker.add(quadOf({-3, {0, 0, 1}, {}}, maker.add(tint({0, 0, 0, 0.75F}))));
    render::Renderer renderer(device(), maker.scene);
    for (const auto transparency :
         {Transparency::kSorted, Transparency::kWeighted, Transparency::kPeeled}) {
        for (const auto kind : {Renderer::kNaive, Renderer::kClusteredDeferred}) {
            for (const float exposure : {0.01F, 1.0F, 100.0F, 0.0F}) {
                auto inputs = inputsFor(transparency);
                inputs.settings.renderer = kind;
                inputs.settings.tone_map = settings::ToneMap::kPbrNeutral;
                if (exposure > 0) {
                    inputs.settings.exposure = exposure;
                } else {
                    inputs.settings.exposure_mode = settings::ExposureMode::kFrame;
                }
                const Picture picture = draw(renderer, inputs);
                const size_t middle = 4 * (size_t{27} * kSize.width_px + 48);
                EXPECT_EQ(std::to_integer<int>(picture.rgba8[middle]), 137)
                    << static_cast<int>(transparency) << " " << static_cast<int>(kind) << " "
                    << exposure;
            }
        }
    }
}

} // namespace froxel::test

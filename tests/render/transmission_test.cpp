// Surfaces that light passes as through glass: exact where nothing is bent or blurred, against the
// double-precision reference elsewhere, and nothing of them where none is in view.
#include "reference_pictures.h"
#include "support/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace froxel::test {

namespace {

using settings::Renderer;
using settings::Transparency;

class TransmissionTest : public SharedGpuTest {};

// Layers that the rasteriser draws, or whose ids compute rasters.
class TransmissionWays : public TransmissionTest,
                         public ::testing::WithParamInterface<render::GeometryPath> {
  protected:
    static render::FrameInputs inputsOf(Renderer renderer = Renderer::kForwardPlus);
};

INSTANTIATE_TEST_SUITE_P(,
                         TransmissionWays,
                         ::testing::Values(render::GeometryPath::kRaster,
                                           render::GeometryPath::kComputeRaster),
                         [](const auto& way) {
                             return way.param == render::GeometryPath::kRaster ? "Raster" : "Ids";
                         });

// It reflects nothing, at no angle.
scene::Material clearGlass(const glm::vec3& tint = glm::vec3(1)) {
    scene::Material material = chalk();
    material.base_color = glm::vec4(tint, 1);
    material.roughness = 0;
    material.specular = 0;
    material.transmission.strength = 1;
    material.double_sided = true;
    return material;
}

scene::Primitive paneAt(float z, uint32_t material, float half = 0.6F) {
    return quad({-half, -half, z}, {2 * half, 0, 0}, {0, 2 * half, 0}, 1, material);
}

// A wall of squares, 5 m ahead.
SceneMaker wallOfSquares() {
    scene::Material dark = chalk();
    dark.base_color = {0.1F, 0.2F, 0.4F, 1};
    SceneMaker maker(dark);
    maker.add(quad({-20, -20, -5.01F}, {40, 0, 0}, {0, 40, 0}, 1, 0));
    scene::Material bright = chalk();
    bright.base_color = {0.9F, 0.6F, 0.3F, 1};
    const uint32_t square = maker.add(bright);
    for (int x = -6; x <= 6; ++x) {
        for (int y = -4; y <= 4; ++y) {
            if ((x + y) % 2 == 0) {
                maker.add(quad({static_cast<float>(x) * 0.5F, static_cast<float>(y) * 0.5F, -5},
                               {0.5F, 0, 0}, {0, 0.5F, 0}, 1, square));
            }
        }
    }
    return maker;
}

render::FrameInputs inputsOf(Renderer renderer = Renderer::kForwardPlus) {
    render::FrameInputs inputs;
    inputs.geometry = render::GeometryPath::kRaster;
    inputs.settings.lighting = settings::LightingStage::kFragment;
    inputs.settings.size = {160, 90};
    inputs.settings.renderer = renderer;
    inputs.settings.lights.count = 0;
    return inputs;
}

render::FrameInputs byIds(render::FrameInputs inputs) {
    inputs.geometry = render::GeometryPath::kComputeRaster;
    inputs.settings.lighting = settings::LightingStage::kCompute;
    return inputs;
}

glm::dvec3 colorAt(const Picture& picture, uint32_t x, uint32_t y) {
    const float* rgb = &picture.radiance[3 * (size_t{y} * picture.width_px + x)];
    return {rgb[0], rgb[1], rgb[2]};
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double error) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(a[c], b[c], error) << "channel " << c;
    }
}

render::FrameInputs TransmissionWays::inputsOf(Renderer renderer) {
    const auto inputs = test::inputsOf(renderer);
    return GetParam() == render::GeometryPath::kRaster ? inputs : byIds(inputs);
}

} // namespace

TEST_P(TransmissionWays, ClearPane_ShowsWhatIsBehindIt_BitForBit) {
    SceneMaker bare = wallOfSquares();
    SceneMaker glazed = wallOfSquares();
    glazed.add(paneAt(-2, glazed.add(clearGlass())));
    render::Renderer without(device(), bare.scene);
    render::Renderer with(device(), glazed.scene);
    for (size_t kind = 0; kind < settings::kRendererNames.size(); ++kind) {
        auto inputs = inputsOf(static_cast<Renderer>(kind));
        for (const auto stage : {inputs.settings.lighting, settings::LightingStage::kCompute}) {
            inputs.settings.lighting = stage;
            const Picture seen = draw(with, inputs);
            EXPECT_TRUE(hasPass(seen, "transmission"));
            EXPECT_EQ(differingFloats(draw(without, inputs), seen), 0U)
                << settings::kRendererNames[kind];
        }
    }
}

// Each pane takes its share of what is behind it, whatever the order of the scene.
TEST_P(TransmissionWays, TintedPanes_OneBehindAnother_MultiplyTheirTints) {
    const std::array<glm::vec3, 3> tints = {
        glm::vec3(0.9F, 0.5F, 0.7F), glm::vec3(0.4F, 0.8F, 0.6F), glm::vec3(0.7F, 0.6F, 0.3F)};
    SceneMaker maker = wallOfSquares();
    for (const int pane : {1, 0, 2}) {
        maker.add(paneAt(-2 - static_cast<float>(pane) * 0.5F,
                         maker.add(clearGlass(tints[static_cast<size_t>(pane)]))));
    }
    SceneMaker bare = wallOfSquares();
    render::Renderer without(device(), bare.scene);
    render::Renderer with(device(), maker.scene);
    const auto wall = colorAt(draw(without, inputsOf()), 80, 45);
    auto inputs = inputsOf();
    expectNear(colorAt(draw(with, inputs), 80, 45),
               wall * glm::dvec3(tints[0] * tints[1] * tints[2]), 1e-6);
    inputs.settings.transparency = Transparency::kPeeled;
    for (uint32_t layers = 1; layers <= 3; ++layers) { // the nearest ones
        inputs.settings.peel_layers = layers;
        glm::dvec3 expected = wall;
        for (uint32_t layer = 0; layer < layers; ++layer) {
            expected *= glm::dvec3(tints[layer]);
        }
        expectNear(colorAt(draw(with, inputs), 80, 45), expected, 1e-6);
    }
}

// Blended surfaces behind a pane are seen through it, and those before it are not.
TEST_P(TransmissionWays, BlendedSurfaces_BehindAndBeforeAPane_AreInTheirPlaces) {
    const auto blended = [](const glm::vec4& color) {
        scene::Material material = chalk();
        material.base_color = color;
        material.alpha_mode = scene::AlphaMode::kBlend;
        material.unlit = true;
        return material;
    };
    const glm::vec4 behind(0.8F, 0.1F, 0.3F, 0.5F);
    const glm::vec4 before(0.1F, 0.7F, 0.2F, 0.25F);
    const glm::vec3 tint(0.5F, 0.75F, 0.25F);
    SceneMaker maker = wallOfSquares();
    maker.add(paneAt(-1.5F, maker.add(blended(before))));
    maker.add(paneAt(-2, maker.add(clearGlass(tint))));
    maker.add(paneAt(-3, maker.add(blended(behind))));
    SceneMaker bare = wallOfSquares();
    render::Renderer without(device(), bare.scene);
    render::Renderer with(device(), maker.scene);
    const auto wall = colorAt(draw(without, inputsOf()), 80, 45);
    const glm::dvec3 expected = glm::mix(glm::mix(wall, glm::dvec3(behind), 0.5) * glm::dvec3(tint),
                                         glm::dvec3(before), 0.25);
    for (const auto transparency :
         {Transparency::kSorted, Transparency::kWeighted, Transparency::kPeeled}) {
        auto inputs = inputsOf();
        inputs.settings.transparency = transparency;
        inputs.settings.tone_map = settings::ToneMap::kClamp; // unlit colours stay as they are
        expectNear(colorAt(draw(with, inputs), 80, 45), expected, 1e-5);
        inputs.settings.lighting = settings::LightingStage::kCompute;
        expectNear(colorAt(draw(with, inputs), 80, 45), expected, 1e-5);
    }
}

// Metal stops light, and so does a surface that the eye does not see.
TEST_F(TransmissionTest, NoneInView_NothingIsMade) {
    scene::Material metal = clearGlass();
    metal.metallic = 1;
    SceneMaker maker = wallOfSquares();
    maker.add(paneAt(-2, maker.add(metal)));
    maker.add(paneAt(2, maker.add(clearGlass())));
    render::Renderer renderer(device(), maker.scene);
    const Picture picture = draw(renderer, inputsOf());
    EXPECT_FALSE(hasPass(picture, "transmission"));
    EXPECT_FALSE(hasPass(picture, "behind"));
    EXPECT_EQ(device().memoryLedger()->byPurpose().count("picture behind"), 0U);
}

namespace {

// Panes and balls of glass before a wall, by lamps on both sides.
SceneMaker glassRoom() {
    SceneMaker maker = wallOfSquares();
    maker.point({1, 1, -1}, 12, 8).point({-1.5, 0.5, -3.5}, 8, 6);
    return maker;
}

scene::Material glass(float ior, float roughness, float thickness_m) {
    scene::Material material = chalk();
    material.base_color = {0.8F, 1, 0.9F, 1};
    material.roughness = roughness;
    material.ior = ior;
    material.transmission.strength = 0.9F;
    material.volume.thickness_m = thickness_m;
    return material;
}

// Of each channel of the pixels of a square about the middle.
double rmseInTheMiddle(const Picture& picture, const LinearImage& expected, uint32_t half) {
    double squares = 0;
    size_t count = 0;
    for (uint32_t y = picture.height_px / 2 - half; y < picture.height_px / 2 + half; ++y) {
        for (uint32_t x = picture.width_px / 2 - half; x < picture.width_px / 2 + half; ++x) {
            for (size_t c = 0; c < 3; ++c) {
                const size_t i = 3 * (size_t{y} * picture.width_px + x) + c;
                squares += std::pow(static_cast<double>(picture.radiance[i]) -
                                        static_cast<double>(expected.rgb[i]),
                                    2);
                ++count;
            }
        }
    }
    return std::sqrt(squares / static_cast<double>(count));
}

class GlassCase {
  public:
    GlassCase(gpu::Device& device, const scene::Scene& scene)
        : scene_(scene), renderer_(device, scene) {}

    double rmse(const render::FrameInputs& inputs,
                reference::LightWay way = reference::LightWay::kToExit) {
        const auto seen = render::readVisibility(renderer_, scene_, inputs);
        if (!seen) {
            ADD_FAILURE() << seen.error().message;
            return 0;
        }
        const auto expected = reference::shade(scene_, inputs.settings, inputs.time_s, *seen, way);
        if (!expected) {
            ADD_FAILURE() << expected.error().message;
            return 0;
        }
        const double error = rmseInTheMiddle(draw(renderer_, inputs), *expected, 20);
        std::printf("R2 in the middle: RMSE %.3g\n", error);
        return error;
    }

  private:
    const scene::Scene& scene_;
    render::Renderer renderer_;
};

} // namespace

// A thin, clear pane bends nothing: what is left is arithmetic.
TEST_P(TransmissionWays, ThinPane_IsTheReference) {
    SceneMaker maker = glassRoom();
    maker.add(paneAt(-2, maker.add(glass(1.5F, 0, 0))));
    maker.add(paneAt(-2.5F, maker.add(glass(1.3F, 0, 0))));
    GlassCase made(device(), maker.scene);
    for (const auto renderer : {Renderer::kNaive, Renderer::kForwardPlus}) {
        EXPECT_LT(made.rmse(inputsOf(renderer)), 1e-5);
    }
    auto inputs = inputsOf();
    inputs.settings.environment.light = settings::EnvironmentLight::kStudio;
    EXPECT_LT(made.rmse(inputs), 1e-5);
    inputs.settings.shading = settings::ShadingModel::kLambert;
    EXPECT_LT(made.rmse(inputs), 1e-5);
    inputs.settings.shading = settings::ShadingModel::kBlinnPhong;
    EXPECT_LT(made.rmse(inputs), 1e-5);
}

TEST_P(TransmissionWays, LampsBehindARoughPane_AreTheReference) {
    scene::Material black = chalk();
    black.base_color = {0, 0, 0, 1};
    black.specular = 0; // else the pane blurs its highlights, by levels
    SceneMaker maker(black);
    maker.add(quad({-20, -20, -5}, {40, 0, 0}, {0, 40, 0}, 1, 0));
    maker.point({0.2, 0.1, -3}, 8, 6).point({-0.3, 0.3, -1}, 8, 2).sun({0.1, 0.2, 1});
    maker.add(paneAt(-2, maker.add(glass(1.5F, 0.4F, 0))));
    GlassCase made(device(), maker.scene);
    for (const auto renderer : {Renderer::kForwardPlus, Renderer::kClusteredDeferred}) {
        // Some of the lobe's rays pass the wall and see the background.
        EXPECT_LT(made.rmse(inputsOf(renderer)), 1e-4);
    }
}

// What a picture behind costs of exactness, in radiance of about 1: its pixels are looked up
// between their centres; a level blurs the same whatever is near or far; a body has one interface.
TEST_P(TransmissionWays, PictureBehind_IsNearWhatRaysSee) {
    struct Case {
        const char* name;
        float roughness;
        float thickness_m;
        bool ball;
        double to_exit;      // measured, a third more
        double through_mesh; // likewise; 0: it is no closed mesh
    };
    for (const Case& it :
         {Case{"thick pane", 0, 0.5F, false, 0.007, 0}, Case{"ball", 0, 0.8F, true, 0.0075, 0.065},
          Case{"pane of roughness 0.2", 0.2F, 0, false, 0.022, 0},
          Case{"pane of roughness 0.5", 0.5F, 0, false, 0.029, 0},
          Case{"rough ball", 0.3F, 0.8F, true, 0.02, 0}}) {
        SCOPED_TRACE(it.name);
        SceneMaker maker = glassRoom();
        const uint32_t material = maker.add(glass(1.5F, it.roughness, it.thickness_m));
        if (it.ball) {
            glm::dmat4 place(1);
            place[3] = {0, 0, -2.5, 1};
            maker.add(sphere(0.5F, 24, material), place);
        } else {
            maker.add(paneAt(-2, material));
        }
        std::printf("%s\n", it.name);
        GlassCase made(device(), maker.scene);
        EXPECT_LT(made.rmse(inputsOf()), it.to_exit);
        if (it.through_mesh > 0) {
            EXPECT_LT(made.rmse(inputsOf(), reference::LightWay::kThroughMesh), it.through_mesh);
        }
    }
}

// Of the picture behind only what is seen is made anew: nothing of earlier frames is.
TEST_P(TransmissionWays, EarlierFrames_AreNotSeen) {
    for (const float roughness : {0.0F, 0.25F, 0.7F}) {
        SCOPED_TRACE(roughness);
        SceneMaker maker = glassRoom();
        const uint32_t material = maker.add(glass(1.5F, roughness, 0.4F));
        for (const double x : {-1.0, 0.4}) {
            glm::dmat4 place(1);
            place[3] = {x, 0.2 * x, -3, 1};
            maker.add(sphere(0.3F, 12, material), place);
        }
        render::Renderer renderer(device(), maker.scene);
        render::ViewRenderer moving(renderer);
        for (const double turn : {0.0, 0.35, -0.5, 0.1}) {
            auto inputs = inputsOf();
            inputs.settings.size = {320, 180};
            inputs.settings.camera =
                settings::lookAt({0, 0, 0}, {std::sin(turn), 0.1, -std::cos(turn)}, {0, 1, 0});
            render::ViewRenderer fresh(renderer);
            EXPECT_EQ(differingFloats(draw(moving, inputs), draw(fresh, inputs)), 0U) << turn;
        }
    }
}

// Lists are all lights, bit for bit.
TEST_P(TransmissionWays, Lists_AreAllLights) {
    SceneMaker maker = glassRoom();
    maker.add(sphere(0.5F, 12, maker.add(glass(1.5F, 0.3F, 0.5F))),
              glm::dmat4({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0.2, 0, -2.5, 1}));
    maker.add(paneAt(-1.5F, maker.add(glass(1.4F, 0, 0)), 0.3F));
    render::Renderer renderer(device(), maker.scene);
    auto inputs = inputsOf();
    inputs.settings.lights.count = 60;
    inputs.settings.light_loop = settings::LightLoop::kLists;
    const Picture lists = draw(renderer, inputs);
    inputs.settings.renderer = Renderer::kNaive;
    EXPECT_EQ(differingFloats(lists, draw(renderer, inputs)), 0U);
}

namespace {

// Balls inside balls, panes with holes, half-covering and mirrored ones, in several materials: up
// to ten layers of a pixel.
SceneMaker muchGlass() {
    SceneMaker maker = glassRoom();
    const std::array balls = {maker.add(glass(1.5F, 0, 0.5F)), maker.add(glass(1.3F, 0.3F, 0.2F))};
    for (int i = 0; i < 6; ++i) {
        glm::dmat4 place(i % 2 == 0 ? 1 : -1);
        place[3] = {-0.9 + 0.35 * i, 0.2 * (i % 3) - 0.2, -2.5 - 0.1 * i, 1};
        maker.add(
            sphere(0.2F + 0.05F * static_cast<float>(i), 16, balls[static_cast<size_t>(i) % 2]),
            place);
    }
    scene::Material half = glass(1.4F, 0, 0);
    half.alpha_mode = scene::AlphaMode::kBlend;
    half.base_color.w = 0.6F;
    half.double_sided = true;
    maker.add(paneAt(-1.6F, maker.add(half), 0.4F));
    scene::Material holed = glass(1.4F, 0, 0);
    holed.alpha_mode = scene::AlphaMode::kMask;
    scene::Primitive pane = paneAt(-1.4F, maker.add(holed), 0.5F);
    pane.colors = {{1, 1, 1, 1}, {1, 1, 1, 0}, {1, 1, 1, 1}, {1, 1, 1, 0}};
    maker.add(std::move(pane));
    return maker;
}

// Of all floats, those that differ by more than a share of the larger.
double shareApart(const Picture& a, const Picture& b, double share) {
    size_t apart = 0;
    for (size_t i = 0; i < a.radiance.size(); ++i) {
        const auto [least, most] = std::minmax<double>(a.radiance[i], b.radiance[i]);
        apart += most - least > share * (most + 0.01) ? 1U : 0U;
    }
    return static_cast<double>(apart) / static_cast<double>(a.radiance.size());
}

} // namespace

// Edges of triangles may show a neighbour, and depths of the two ways are apart by their rounding:
// nothing else differs.
TEST_F(TransmissionTest, Ids_AreWhatTheRasteriserDraws) {
    SceneMaker maker = muchGlass();
    render::Renderer renderer(device(), maker.scene);
    for (const auto kind :
         {Renderer::kForwardPlus, Renderer::kClusteredDeferred, Renderer::kToonCompute}) {
        for (const auto transparency : {Transparency::kSorted, Transparency::kPeeled}) {
            auto inputs = inputsOf(kind);
            inputs.settings.size = {320, 180};
            inputs.settings.transparency = transparency;
            inputs.settings.peel_layers = 12;
            inputs.settings.fog.density = 0.1F;
            const Picture drawn = draw(renderer, inputs);
            const Picture shaded = draw(renderer, byIds(inputs));
            EXPECT_FALSE(hasPass(drawn, "raster_meshlets"));
            EXPECT_TRUE(hasPass(shaded, "raster_meshlets"));
            EXPECT_LE(shareApart(drawn, shaded, 0.01), 0.005); // seen: 0.0025
            EXPECT_EQ(shareApart(drawn, shaded, 0.1), 0);
        }
    }
}

} // namespace froxel::test

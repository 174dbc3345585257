// The device's pictures against the double-precision reference (R2). Bounds of untextured scenes
// are derived from fp32 arithmetic; those of textured ones are what was measured and explained,
// doubled.
#include "builtin_scene/hall.h"
#include "reference/shade.h"
#include "render/visibility_readback.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/test_scenes.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

namespace froxel::test {

namespace {

using settings::Renderer;
using settings::ShadingModel;

class Reference : public GpuTest {};

render::FrameInputs inputsFor(const settings::Camera& camera, Renderer renderer) {
    render::FrameInputs inputs;
    inputs.settings.camera = camera;
    inputs.settings.size = {160, 90};
    inputs.settings.renderer = renderer;
    inputs.settings.lights.count = 60;
    inputs.time_s = 3.25;
    return inputs;
}

// A step between bands is as large as a band, however small the error that crosses it.
render::FrameInputs withoutBands(render::FrameInputs inputs) {
    inputs.settings.toon = {.bands = 0, .rim = 0};
    return inputs;
}

// The largest relative error that fp32 may leave; of_lavapipe: whose operations round to nearest. A
// GPU's quotients, roots and powers are off by up to 3 units of the last place, and its rasteriser
// interpolates depths less exactly than a plane is met. Measured on an H200, doubled: 1.8e-4 where
// triangles are met in compute, 1.5e-3 where they come from the rasteriser.
double arithmeticBound(double of_lavapipe, settings::LightingStage stage) {
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

double percentile(std::vector<double>& values, double share) {
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<size_t>(at)];
}

Errors errorsOf(const Picture& picture, const LinearImage& expected) {
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
scene::Scene makePlainRoom() {
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

std::string nameOf(Renderer renderer) {
    return std::string(settings::kRendererNames[static_cast<size_t>(renderer)]);
}

} // namespace

// Without textures and without a G-buffer only fp32 is left: positions carry the depth's rounding,
// 2^-23 of their distance (10 m: 1.2 um), which at the nearest light, 3 cm away, is 4e-5 of the way
// to it, doubled by 1 / d^2; summing 60 lights adds at most 60 * 2^-24 = 4e-6. The lobe's slope, at
// roughness 0.3, multiplies an angle by up to 1 / alpha = 11.
TEST_F(Reference, PlainRoom_Forward_IsWithinArithmetic) {
    const auto room = makePlainRoom();
    Compared compared(device(), room);
    for (const auto& camera : room.cameras) {
        for (const auto model :
             {ShadingModel::kLambert, ShadingModel::kBlinnPhong, ShadingModel::kPbr}) {
            auto inputs = inputsFor(camera.camera, Renderer::kNaive);
            inputs.settings.shading = model;
            const Errors errors = compared.against(inputs);
            EXPECT_LT(errors.max_relative,
                      arithmeticBound(1e-4, settings::LightingStage::kCompute));
            EXPECT_LT(errors.median, 1e-7);
        }
    }
}

// The default G-buffer: base colour in 8 bits of gamma 2 (an error of up to 1/255 of its root,
// twice), roughness in 8 bits, normals within 0.0036 degrees, emission within 2^-9.
TEST_F(Reference, PlainRoom_Deferred_IsWithinTheGbuffersSteps) {
    const auto room = makePlainRoom();
    Compared compared(device(), room);
    for (const auto renderer :
         {Renderer::kClusteredDeferred, Renderer::kToonFragment, Renderer::kToonCompute}) {
        SCOPED_TRACE(nameOf(renderer));
        const auto inputs = withoutBands(inputsFor(room.cameras[0].camera, renderer));
        const Errors errors = compared.against(inputs);
        // A ramp's slope, up to 9 here, multiplies what reaches it.
        EXPECT_LT(errors.max_relative, renderer == Renderer::kClusteredDeferred ? 0.02 : 0.1);
        EXPECT_LT(errors.rmse, 2e-3);
    }
}

namespace {

// A dense floor and wall that reflect half at their edges, half a metal whose dielectric part is
// tinted beyond what is clamped, and what an infinite index makes of its colour.
void giveReflectances(scene::Scene& room) {
    auto& floor = room.materials[0];
    floor.base_color = {0.7F, 0.5F, 0.3F, 1};
    floor.ior = 2.4F;
    floor.specular = 0.5F;
    floor.specular_color = {1, 0.8F, 0.6F};
    auto& half = room.materials[3];
    half.metallic = 0.5F;
    half.specular_color = {30, 1, 0};
    auto& glossy = room.materials[4];
    glossy.ior = 0;
    glossy.specular_color = {0.3F, 0.5F, 0.2F};
    glossy.roughness = 0.4F;
}

} // namespace

TEST_F(Reference, RoomOfReflectances_Forward_IsWithinArithmetic) {
    auto room = makePlainRoom();
    giveReflectances(room);
    Compared compared(device(), room);
    for (const auto& camera : room.cameras) {
        for (const auto model : {ShadingModel::kBlinnPhong, ShadingModel::kPbr}) {
            for (const auto stage :
                 {settings::LightingStage::kFragment, settings::LightingStage::kCompute}) {
                auto inputs = inputsFor(camera.camera, Renderer::kForwardPlus);
                inputs.settings.shading = model;
                inputs.settings.lighting = stage;
                const Errors errors = compared.against(inputs);
                EXPECT_LT(errors.max_relative, arithmeticBound(1e-4, stage));
                EXPECT_LT(errors.median, onGpu() ? 1e-6 : 1e-7);
            }
        }
    }
}

// As PlainRoom_Deferred: f0 has 8 bits of gamma 2, too.
TEST_F(Reference, RoomOfReflectances_Deferred_IsWithinTheGbuffersSteps) {
    auto room = makePlainRoom();
    giveReflectances(room);
    Compared compared(device(), room);
    for (const auto renderer :
         {Renderer::kClusteredDeferred, Renderer::kToonFragment, Renderer::kToonCompute}) {
        SCOPED_TRACE(nameOf(renderer));
        const Errors errors =
            compared.against(withoutBands(inputsFor(room.cameras[0].camera, renderer)));
        EXPECT_LT(errors.max_relative, renderer == Renderer::kClusteredDeferred ? 0.03 : 0.15);
        EXPECT_LT(errors.rmse, 4e-3);
    }
}

// As both. Levels are filtered in fp32: a direction's rounding is 1e-5 of a texel. What is around
// scatters in fog by its mean.
TEST_F(Reference, RoomInTheStudio_Forward_IsWithinArithmetic) {
    auto room = makePlainRoom();
    giveReflectances(room);
    Compared compared(device(), room);
    for (const auto& camera : room.cameras) {
        for (const auto model :
             {ShadingModel::kLambert, ShadingModel::kBlinnPhong, ShadingModel::kPbr}) {
            auto inputs = inputsFor(camera.camera, Renderer::kForwardPlus);
            inputs.settings.shading = model;
            inputs.settings.environment = {settings::EnvironmentLight::kStudio, 40, 1.5F};
            const double bound = arithmeticBound(1e-4, settings::LightingStage::kCompute);
            EXPECT_LT(compared.against(inputs).max_relative, bound);
            inputs.settings.lights.count = 0;
            inputs.settings.lights.scene_lights = false;
            inputs.settings.fog.density = 0.1F;
            inputs.settings.environment.background = true;
            EXPECT_LT(compared.against(inputs).max_relative, bound);
        }
    }
}

TEST_F(Reference, RoomInTheStudio_Deferred_IsWithinTheGbuffersSteps) {
    auto room = makePlainRoom();
    giveReflectances(room);
    Compared compared(device(), room);
    for (const auto renderer : {Renderer::kClusteredDeferred, Renderer::kToonFragment}) {
        SCOPED_TRACE(nameOf(renderer));
        auto inputs = withoutBands(inputsFor(room.cameras[0].camera, renderer));
        inputs.settings.environment = {settings::EnvironmentLight::kStudio, -130, 1};
        const Errors errors = compared.against(inputs);
        EXPECT_LT(errors.max_relative, 0.02);
        EXPECT_LT(errors.rmse, 7e-3);
    }
}

namespace {

// Nearest texels, so that nothing is filtered: what is left is the driver's sRGB polynomial, and
// texels at whose edges a pixel lies.
scene::Scene makeNearestRoom() {
    auto room = makePlainRoom();
    room.samplers[0] = {.mag = scene::Filter::kNearest,
                        .min = scene::Filter::kNearest,
                        .mip = scene::Filter::kNearest,
                        .mipmapped = false};
    return room;
}

// Of the 99.9th percentile. Lavapipe leaves at most 1.4e-5 in the tests below.
double nearestBound() {
    return arithmeticBound(3e-5, settings::LightingStage::kFragment);
}

void expectInBothStages(Compared& compared, const scene::Scene& room, double median, double p999) {
    for (const auto stage :
         {settings::LightingStage::kFragment, settings::LightingStage::kCompute}) {
        auto inputs = inputsFor(room.cameras[0].camera, Renderer::kForwardPlus);
        inputs.settings.lighting = stage;
        const Errors errors = compared.against(inputs);
        EXPECT_LT(errors.median, median);
        EXPECT_LT(errors.p999, p999);
    }
}

} // namespace

// Floor and wall, matt and glossy, in even light, in the studio and under lights.
TEST_F(Reference, RoomOfOcclusion_IsWithinArithmetic) {
    auto room = makeNearestRoom();
    for (auto& material : room.materials) {
        material.occlusion_texture = {0, 0, {0.1F, 0.2F}, 0.3F, {2, 1}}; // 0.35 and 0.78
        material.occlusion_strength = 0.5F;
    }
    for (const float roughness : {0.3F, 0.9F}) {
        room.materials[0].roughness = roughness;
        Compared compared(device(), room);
        for (const auto around :
             {settings::EnvironmentLight::kOff, settings::EnvironmentLight::kStudio}) {
            auto inputs = inputsFor(room.cameras[0].camera, Renderer::kForwardPlus);
            inputs.settings.lights.count = 5;
            inputs.settings.environment = {around, 40, 1.5F};
            const Errors errors = compared.against(inputs);
            EXPECT_LT(errors.median, 1e-6);
            EXPECT_LT(errors.p999, nearestBound());
            inputs.settings.renderer = Renderer::kClusteredDeferred;
            EXPECT_LT(compared.against(inputs).rmse, 5e-3); // G-buffer's steps
        }
    }
}

// Dents half as deep and twice as deep.
TEST_F(Reference, NormalScale_IsOfBothAxes) {
    for (const float scale : {0.5F, 2.0F}) {
        auto room = makeNearestRoom();
        room.materials[0].normal_texture.texture = 1;
        room.materials[0].normal_scale = scale;
        Compared compared(device(), room);
        expectInBothStages(compared, room, 1e-6, nearestBound());
    }
}

TEST_F(Reference, CoatNormalScale_IsOfBothAxes) {
    for (const float scale : {0.5F, 2.0F}) {
        auto room = makeNearestRoom();
        auto& floor = room.materials[0];
        floor.coat = 1;
        floor.coat_roughness = 0.3F;
        floor.coat_normal_texture.texture = 1;
        floor.coat_normal_scale = scale;
        Compared compared(device(), room);
        const Errors errors =
            compared.against(inputsFor(room.cameras[0].camera, Renderer::kForwardPlus));
        EXPECT_LT(errors.median, 1e-6);
        EXPECT_LT(errors.p999, nearestBound());
    }
}

// All that is seen is rough by its texture's A, which is 0 or 1, and by its own factor.
TEST_F(Reference, RoomOfGlossiness_IsWithinArithmetic) {
    auto room = makeNearestRoom();
    for (auto& material : room.materials) {
        material.specular_color_texture.texture = 2;
        material.glossiness_texture = true;
        material.roughness = 0.6F;
        material.metallic = 0;
    }
    Compared compared(device(), room);
    expectInBothStages(compared, room, 1e-5, 4 * nearestBound()); // sRGB, too
}

// Strength, colour and glossiness out of textures.
TEST_F(Reference, RoomOfTexturedReflectances_IsWithinArithmetic) {
    auto room = makeNearestRoom();
    auto& floor = room.materials[0];
    floor.ior = 1.8F;
    floor.specular_texture.texture = 2; // with holes in A
    floor.specular_color_texture = {0, 0, {0.1F, 0.2F}, 0.3F, {2, 1}};
    auto& glossy = room.materials[4];
    glossy.ior = 0;
    glossy.specular_color_texture.texture = 2;
    glossy.glossiness_texture = true;
    glossy.roughness = 0.5F;
    glossy.metallic = 0;
    Compared compared(device(), room);
    // The driver's sRGB polynomial; and texels at whose edges a pixel lies.
    expectInBothStages(compared, room, 1e-5, 5e-3);
}

namespace {

// Of coats in every way that needs no texture.
void givePlainCoats(scene::Scene& room) {
    giveReflectances(room);
    for (const auto& [material, coat, roughness] :
         {std::tuple(size_t{0}, 1.0F, 0.3F), std::tuple(size_t{2}, 1.0F, 0.5F),
          std::tuple(size_t{3}, 0.5F, 1.0F), std::tuple(size_t{4}, 0.7F, 0.4F)}) {
        room.materials[material].coat = coat;
        room.materials[material].coat_roughness = roughness;
    }
}

} // namespace

// As RoomOfReflectances, which is below the coats. Seen along it, the floor shows all of its coat's
// lobe, whatever the light's half vector: twice the bound.
TEST_F(Reference, RoomOfCoats_Forward_IsWithinArithmetic) {
    auto room = makePlainRoom();
    givePlainCoats(room);
    Compared compared(device(), room);
    for (const auto& camera : room.cameras) {
        for (const auto model :
             {ShadingModel::kLambert, ShadingModel::kBlinnPhong, ShadingModel::kPbr}) {
            for (const auto stage :
                 {settings::LightingStage::kFragment, settings::LightingStage::kCompute}) {
                auto inputs = inputsFor(camera.camera, Renderer::kForwardPlus);
                inputs.settings.shading = model;
                inputs.settings.lighting = stage;
                EXPECT_LT(compared.against(inputs).max_relative, arithmeticBound(2e-4, stage));
                inputs.settings.environment = {settings::EnvironmentLight::kStudio, 40, 1.5F};
                EXPECT_LT(compared.against(inputs).max_relative, arithmeticBound(2e-4, stage));
            }
        }
    }
}

// The forward shader draws coats and what they cover, here everything that is solid but the leaves.
TEST_F(Reference, RoomOfCoats_Deferred_IsWithinTheGbuffersSteps) {
    auto room = makePlainRoom();
    givePlainCoats(room);
    Compared compared(device(), room);
    for (const auto renderer :
         {Renderer::kClusteredDeferred, Renderer::kToonFragment, Renderer::kToonCompute}) {
        SCOPED_TRACE(nameOf(renderer));
        const Errors errors =
            compared.against(withoutBands(inputsFor(room.cameras[0].camera, renderer)));
        EXPECT_LT(errors.max_relative, arithmeticBound(1e-3, settings::LightingStage::kFragment));
        EXPECT_LT(errors.median, onGpu() ? 1e-6 : 1e-7);
    }
}

// Bands and the rim: beside steps the picture is the reference's within the G-buffer's own; pixels
// on the other side of a step are few.
TEST_F(Reference, ToonBandsAndRim_AreTheReferencesButAtSteps) {
    const auto plain = makePlainRoom();
    auto coated = plain;
    givePlainCoats(coated);
    for (const auto& room : {plain, coated}) {
        Compared compared(device(), room);
        for (const auto renderer : {Renderer::kToonFragment, Renderer::kToonCompute}) {
            for (const auto model :
                 {ShadingModel::kLambert, ShadingModel::kBlinnPhong, ShadingModel::kPbr}) {
                SCOPED_TRACE(nameOf(renderer));
                auto inputs = inputsFor(room.cameras[0].camera, renderer);
                inputs.settings.shading = model;
                inputs.settings.toon = {.bands = 4, .rim = 0.7F, .rim_width = 0.4F};
                const Errors errors = compared.against(inputs);
                EXPECT_LT(errors.rmse, 0.02); // by pixels at steps; 0.0095 at most
                EXPECT_LT(errors.median, 1e-3);
            }
        }
    }
}

// Strength, roughness and bumps out of textures, nearest so that nothing is filtered.
TEST_F(Reference, RoomOfTexturedCoats_IsWithinArithmetic) {
    auto room = makePlainRoom();
    room.samplers[0] = {.mag = scene::Filter::kNearest,
                        .min = scene::Filter::kNearest,
                        .mip = scene::Filter::kNearest,
                        .mipmapped = false};
    giveCoats(room);
    Compared compared(device(), room);
    for (const auto stage :
         {settings::LightingStage::kFragment, settings::LightingStage::kCompute}) {
        auto inputs = inputsFor(room.cameras[0].camera, Renderer::kForwardPlus);
        inputs.settings.lighting = stage;
        const Errors errors = compared.against(inputs);
        EXPECT_LT(errors.median, 1e-5);
        EXPECT_LT(errors.p999, 5e-3); // texels at whose edges a pixel lies
    }
}

// A floor without light whose levels have other colours than their halves would have; the last
// two are made of the last that is given.
TEST_F(Reference, GivenMipLevels_AreThoseThatAreDrawn) {
    auto room = makePlainRoom();
    room.materials[0].unlit = true;
    room.materials[0].base_color_texture.texture = 0;
    room.images[0].mips = {std::vector(size_t{4} * 16 * 16, std::byte{60}),
                           std::vector(size_t{4} * 8 * 8, std::byte{180}),
                           std::vector(size_t{4} * 4 * 4, std::byte{250})};
    Compared compared(device(), room);
    const auto inputs = inputsFor(room.cameras[0].camera, Renderer::kForwardPlus);
    const Errors errors = compared.against(inputs);
    EXPECT_LT(errors.median, 1e-3);
    EXPECT_LT(errors.rmse, 0.02); // the level of detail is one for four pixels
}

TEST_F(Reference, PlainRoom_OtherCameras_AreWithinArithmetic) {
    const auto room = makePlainRoom();
    Compared compared(device(), room);
    auto inputs = inputsFor(room.cameras[0].camera, Renderer::kForwardPlus);
    inputs.settings.shading = ShadingModel::kLambert;
    inputs.settings.camera.lens_shift = {0.3, -0.4};
    EXPECT_LT(compared.against(inputs).max_relative, 1e-4);
    inputs.settings.camera.projection = settings::Projection::kOrthographic;
    inputs.settings.camera.half_height_m = 3;
    EXPECT_LT(compared.against(inputs).max_relative, 1e-4);
}

TEST_F(Reference, PlainRoom_AThousandKilometresAway_IsWithinArithmetic) {
    auto room = makePlainRoom();
    const glm::dvec3 offset(1e6, -1e6, 1e6);
    for (auto& instance : room.instances) {
        instance.world_from_object[3] += glm::dvec4(offset, 0);
    }
    for (auto& light : room.lights) {
        light.position_world += offset;
    }
    room.bounds_world.min += offset;
    room.bounds_world.max += offset;
    room.cameras[0].camera.eye_world += offset;
    Compared compared(device(), room);
    auto inputs = inputsFor(room.cameras[0].camera, Renderer::kForwardPlus);
    inputs.settings.shading = ShadingModel::kLambert;
    EXPECT_LT(compared.against(inputs).max_relative, 1e-4);
}

// Seen from behind, bumps are dents: normal maps on both sides of a pane. No mip levels: what
// is left is lavapipe's 8-bit filter of the normal map.
TEST_F(Reference, NormalMapSeenFromBehind_IsReversed) {
    auto room = makeRoom();
    room.samplers[0].mipmapped = false;
    room.materials[1].alpha_mode = scene::AlphaMode::kOpaque;
    room.materials[1].base_color_texture = {};
    room.materials[1].normal_texture.texture = 1;
    room.instances.erase(room.instances.begin() + 3, room.instances.end());
    room.instances[0].world_from_object[3].y = -1;
    Compared compared(device(), room);
    const auto behind = settings::lookAt({-2, 1, -1.5}, {-2, 1, 1}, {0, 1, 0});
    auto inputs = inputsFor(behind, Renderer::kForwardPlus);
    EXPECT_LT(compared.against(inputs).rmse, 2e-3);
}

// The coat of a sheet that has two sides looks to the eye, its map too.
TEST_F(Reference, CoatSeenFromBehind_IsReversed) {
    auto room = makeNearestRoom();
    auto& sheet = room.materials[1];
    sheet.alpha_mode = scene::AlphaMode::kOpaque;
    sheet.coat = 1;
    sheet.coat_roughness = 0.3F;
    room.instances.erase(room.instances.begin() + 3, room.instances.end());
    room.instances[0].world_from_object[3].y = -1;
    const auto behind = settings::lookAt({-2, 1, -1.5}, {-2, 1, 1}, {0, 1, 0});
    for (const bool mapped : {false, true}) {
        sheet.coat_normal_texture.texture = mapped ? 1 : scene::kNone;
        Compared compared(device(), room);
        const Errors errors = compared.against(inputsFor(behind, Renderer::kForwardPlus));
        EXPECT_LT(errors.median, 1e-6);
        EXPECT_LT(errors.p999, nearestBound());
    }
}

// Vertices of random colours and unlit: a pixel that shows another triangle, or the same
// elsewhere, has another colour. The fragment path's and the visibility path's surfaces are the
// same. Corners snap to 1/256 of a pixel, so colours move by 0.003 of their change over a
// pixel, which is up to 0.7.
TEST_F(Reference, Surfaces_OfTheRasterPath_AreThoseOfTheVisibilityPath) {
    auto scene = makePlainRoom();
    std::mt19937 random(3);
    std::uniform_real_distribution<float> channel(0.0F, 1.0F);
    for (auto& mesh : scene.meshes) {
        for (auto& p : mesh.primitives) {
            p.colors.clear();
            for (size_t i = 0; i < p.positions.size(); ++i) {
                p.colors.emplace_back(channel(random), channel(random), channel(random), 1.0F);
            }
        }
    }
    for (auto& material : scene.materials) {
        material = {};
        material.unlit = true;
    }
    Compared compared(device(), scene);
    for (const auto& camera : scene.cameras) {
        EXPECT_LT(compared.against(inputsFor(camera.camera, Renderer::kNaive)).max, 2e-3);
    }
}

namespace {

struct Figures {
    double rmse;
    double p999;
};

// 640x360 and 1,000 lights; doubled figures of the device.
void expectFigures(gpu::Device& device,
                   const scene::Scene& scene,
                   const render::FrameInputs& base,
                   const Figures& bounds) {
    Compared compared(device, scene);
    for (const auto renderer : {Renderer::kForwardPlus, Renderer::kClusteredDeferred}) {
        SCOPED_TRACE(nameOf(renderer));
        auto inputs = base;
        inputs.settings.size = {640, 360};
        inputs.settings.renderer = renderer;
        inputs.settings.lights.count = 1000;
        const Errors errors = compared.against(inputs);
        EXPECT_LT(errors.rmse, bounds.rmse);
        EXPECT_LT(errors.p999, bounds.p999);
    }
}

} // namespace

// Lavapipe 22.3: RMSE 0.0205 and p99.9 0.091, of which lavapipe's fixed-point filter of 8-bit
// linear textures (normal maps first) makes most: without it (GALLIVM_PERF=no_aos_sampling) 0.0127
// and 0.042. The largest differences are highlights of 30 to 800 in polished stone. The median,
// 0.00038, is the base colour's: mip levels rounded to 8 bits, and a level of detail for four
// pixels at once (without mip levels 0.00004, the driver's sRGB polynomial). H200, whose filter the
// reference has: 0.0095 and 0.030.
TEST_F(Reference, Hall_IsWithinTheTextureFilter) {
    const auto hall = builtin_scene::makeHall();
    expectFigures(device(), hall, inputsFor(hall.cameras[0].camera, Renderer::kNaive),
                  onGpu() ? Figures{0.019, 0.06} : Figures{0.041, 0.19});
}

// Lavapipe 22.3: RMSE 0.0077 and p99.9 0.063. H200: 0.0030 and 0.025.
TEST_F(Reference, Sponza_IsWithinTheTextureFilter) {
    const auto sponza = loadSponza();
    if (!sponza) {
        GTEST_SKIP() << "Sponza is not here: set FROXEL_SPONZA to its .gltf file";
    }
    auto inputs = inputsFor(settings::lookAt({-7, 2, 0}, {0, 2, 0}, {0, 1, 0}), Renderer::kNaive);
    inputs.settings.lights.box = BoundsD3{{-10, 0, -5}, {10, 8, 5}};
    expectFigures(device(), *sponza, inputs, onGpu() ? Figures{0.006, 0.05} : Figures{0.016, 0.13});
}

} // namespace froxel::test

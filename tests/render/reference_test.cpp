// The device's pictures against the double-precision reference (R2). Bounds of untextured scenes
// are derived from fp32 arithmetic; those of textured ones are what was measured and explained,
// doubled.
#include "builtin_scene/hall.h"
#include "reference_pictures.h"

#include <random>
#include <tuple>

namespace froxel::test {

namespace {

using settings::Renderer;
using settings::ShadingModel;

class Reference : public GpuTest {};

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

// Of coats in every way that needs no texture.
void givePlainCoats(scene::Scene& room) {
    giveReflectances(room);
    for (const auto& [material, coat, roughness] :
         {std::tuple(size_t{0}, 1.0F, 0.3F), std::tuple(size_t{2}, 1.0F, 0.5F),
          std::tuple(size_t{3}, 0.5F, 1.0F), std::tuple(size_t{4}, 0.7F, 0.4F)}) {
        room.materials[material].coat.strength = coat;
        room.materials[material].coat.roughness = roughness;
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

namespace {

// Of fibres in every way that needs no texture, below coats.
void givePlainSheen(scene::Scene& room) {
    givePlainCoats(room);
    for (const auto& [material, color, roughness] :
         {std::tuple(size_t{0}, glm::vec3(0.9F, 0.5F, 0.2F), 0.3F),
          std::tuple(size_t{2}, glm::vec3(1), 0.0F), std::tuple(size_t{3}, glm::vec3(1), 1.0F),
          std::tuple(size_t{4}, glm::vec3(0.2F, 0.4F, 0.9F), 0.6F)}) {
        room.materials[material].sheen = {.color = color, .roughness = roughness};
    }
    room.materials[0].coat.strength = 0;
}

} // namespace

// By the albedo's fit, which is within 0.0034 of the reference's integral, as a share of what
// comes.
TEST_F(Reference, RoomOfSheen_IsWithinItsFit) {
    auto room = makePlainRoom();
    givePlainSheen(room);
    Compared compared(device(), room);
    for (const auto& camera : room.cameras) {
        for (const auto renderer : {Renderer::kForwardPlus, Renderer::kClusteredDeferred}) {
            for (const auto model : {ShadingModel::kBlinnPhong, ShadingModel::kPbr}) {
                auto inputs = inputsFor(camera.camera, renderer);
                inputs.settings.shading = model;
                Errors errors = compared.against(inputs);
                EXPECT_LT(errors.max_relative, 0.02);
                EXPECT_LT(errors.rmse, 2e-3);
                inputs.settings.environment = {settings::EnvironmentLight::kStudio, 40, 1.5F};
                errors = compared.against(inputs);
                EXPECT_LT(errors.max_relative, 0.02);
                EXPECT_LT(errors.rmse, 2e-3);
            }
        }
    }
}

// What is around, too: by the same bent normal on both sides. A rasteriser derives tangents from
// differences of its own between pixels, which a GPU's snapped corners move: 3.5e-3.
TEST_F(Reference, RoomOfAnisotropy_IsWithinArithmetic) {
    auto room = makePlainRoom();
    giveReflectances(room);
    for (const auto& [material, strength, rotation] :
         {std::tuple(size_t{0}, 0.6F, 0.0F), std::tuple(size_t{2}, 1.0F, 0.7F),
          std::tuple(size_t{3}, 0.3F, 1.5F), std::tuple(size_t{4}, 1.0F, -2.0F)}) {
        room.materials[material].anisotropy = {.strength = strength, .rotation_rad = rotation};
        room.materials[material].roughness = 0.4F;
    }
    room.materials[4].coat.strength = 1;
    room.materials[4].coat.roughness = 0.5F;
    Compared compared(device(), room);
    for (const auto& camera : room.cameras) {
        for (const auto stage :
             {settings::LightingStage::kFragment, settings::LightingStage::kCompute}) {
            for (const auto model : {ShadingModel::kPbr, ShadingModel::kBlinnPhong}) {
                auto inputs = inputsFor(camera.camera, Renderer::kForwardPlus);
                inputs.settings.shading = model;
                inputs.settings.lighting = stage;
                const double bound = 2 * arithmeticBound(1e-4, stage);
                EXPECT_LT(compared.against(inputs).max_relative, bound);
                inputs.settings.environment = {settings::EnvironmentLight::kStudio, 40, 1.5F};
                EXPECT_LT(compared.against(inputs).max_relative, bound);
            }
        }
    }
}

namespace {

// By ids, or through the G-buffer with its steps; lit by lights, then by what is around, too.
void expectByLightsAndAround(Compared& compared, render::FrameInputs inputs) {
    inputs.settings.lighting = settings::LightingStage::kCompute;
    const double bound = arithmeticBound(2e-4, settings::LightingStage::kFragment) *
                         (inputs.settings.renderer == Renderer::kForwardPlus ? 1 : 5);
    EXPECT_LT(compared.against(inputs).max_relative, bound);
    inputs.settings.environment = {settings::EnvironmentLight::kStudio, 40, 1.5F};
    EXPECT_LT(compared.against(inputs).max_relative, bound);
}

} // namespace

// Films on dielectrics, metals and both, thin and thick, of all and of a part.
TEST_F(Reference, RoomOfFilms_IsWithinArithmetic) {
    auto room = makePlainRoom();
    giveReflectances(room);
    for (const auto& [material, strength, ior, thickness] :
         {std::tuple(size_t{0}, 0.8F, 1.8F, 300.0F), std::tuple(size_t{2}, 1.0F, 1.3F, 550.0F),
          std::tuple(size_t{3}, 1.0F, 1.33F, 900.0F), std::tuple(size_t{4}, 0.5F, 2.4F, 5.0F)}) {
        room.materials[material].film = {.strength = strength, .ior = ior, .most_nm = thickness};
    }
    room.materials[4].coat.strength = 1;
    room.materials[4].coat.roughness = 0.5F;
    Compared compared(device(), room);
    for (const auto& camera : room.cameras) {
        for (const auto renderer : {Renderer::kForwardPlus, Renderer::kClusteredDeferred}) {
            for (const auto model : {ShadingModel::kPbr, ShadingModel::kBlinnPhong}) {
                auto inputs = inputsFor(camera.camera, renderer);
                inputs.settings.shading = model;
                expectByLightsAndAround(compared, inputs);
            }
        }
    }
}

// Light from behind through thin and thick, of all and of a part, below coats and films.
TEST_F(Reference, RoomThatLetsLightThrough_IsWithinArithmetic) {
    auto room = makePlainRoom();
    giveReflectances(room);
    for (const auto& [material, strength, color] :
         {std::tuple(size_t{0}, 0.5F, glm::vec3(0.9F, 0.5F, 0.2F)),
          std::tuple(size_t{2}, 1.0F, glm::vec3(0.2F, 0.8F, 0.3F)),
          std::tuple(size_t{3}, 0.8F, glm::vec3(1)), std::tuple(size_t{4}, 0.3F, glm::vec3(1))}) {
        room.materials[material].diffuse_transmission = {.color = color, .strength = strength};
    }
    room.materials[3].volume = {
        .attenuation_color = {0.9F, 0.4F, 1}, .attenuation_m = 0.2F, .thickness_m = 0.3F};
    room.materials[3].film = {.strength = 0.6F, .most_nm = 500};
    room.materials[4].coat.strength = 1;
    Compared compared(device(), room);
    for (const auto& camera : room.cameras) {
        for (const auto renderer : {Renderer::kForwardPlus, Renderer::kClusteredDeferred}) {
            for (const auto model : {ShadingModel::kPbr, ShadingModel::kLambert}) {
                if (renderer != Renderer::kForwardPlus && model == ShadingModel::kLambert) {
                    continue; // which has none of it: the G-buffer's steps
                }
                auto inputs = inputsFor(camera.camera, renderer);
                inputs.settings.shading = model;
                expectByLightsAndAround(compared, inputs);
            }
        }
    }
}

// Coats and what they cover, here everything that is solid but the leaves, are drawn by the forward
// shader or, from ids, by its twin in compute.
TEST_F(Reference, RoomOfCoats_Deferred_IsWithinTheGbuffersSteps) {
    auto room = makePlainRoom();
    givePlainCoats(room);
    Compared compared(device(), room);
    for (const auto renderer :
         {Renderer::kClusteredDeferred, Renderer::kToonFragment, Renderer::kToonCompute}) {
        SCOPED_TRACE(nameOf(renderer));
        for (const auto path : {render::GeometryPath::kRaster, render::GeometryPath::kVisibility}) {
            auto inputs = withoutBands(inputsFor(room.cameras[0].camera, renderer));
            inputs.geometry = path;
            const Errors errors = compared.against(inputs);
            EXPECT_LT(errors.max_relative,
                      arithmeticBound(1e-3, settings::LightingStage::kFragment));
            EXPECT_LT(errors.median, onGpu() ? 1e-6 : 1e-7);
        }
    }
}

// Bands and the rim: beside steps the picture is the reference's within the G-buffer's own; pixels
// on the other side of a step are few.
TEST_F(Reference, ToonBandsAndRim_AreTheReferencesButAtSteps) {
    const auto plain = makePlainRoom();
    auto coated = plain;
    givePlainCoats(coated);
    auto cloth = plain;
    givePlainSheen(cloth);
    cloth.materials[3].film = {.strength = 0.8F};
    cloth.materials[0].diffuse_transmission = {.color = {0.9F, 0.6F, 0.3F}, .strength = 0.6F};
    cloth.materials[3].anisotropy = {.strength = 0.8F, .rotation_rad = 0.5F};
    for (const auto& room : {plain, coated, cloth}) {
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

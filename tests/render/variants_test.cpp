// Only what a scene needs: nothing is allocated or compiled for what is absent, and every
// specialised variant gives the same bits as the generic one.
#include "builtin_scene/hall.h"
#include "interface/constants.h"
#include "render/pipelines/texture_limit.h"
#include "render/scene/scene_resources.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/test_scenes.h"
#include "support/tier.h"

#include <algorithm>
#include <array>
#include <span>

namespace froxel::test {

namespace {

using render::FrameInputs;
using render::GenericParts;
using settings::Renderer;
using ::testing::Contains;
using ::testing::Key;
using ::testing::Not;

class Variants : public GpuTest {
  protected:
    [[nodiscard]] std::map<std::string, uint64_t> memory() {
        return device().memoryLedger()->byPurpose();
    }
};

constexpr std::array kAllRenderers = {Renderer::kNaive, Renderer::kForwardPlus,
                                      Renderer::kClusteredDeferred, Renderer::kToonFragment,
                                      Renderer::kToonCompute};

FrameInputs inputsFor(const scene::Scene& scene, Renderer renderer, uint32_t lights) {
    FrameInputs inputs;
    inputs.settings.camera = scene.cameras[0].camera;
    inputs.settings.size = {120, 68};
    inputs.settings.renderer = renderer;
    inputs.settings.light_loop = settings::LightLoop::kLists;
    inputs.settings.lights.count = lights;
    inputs.time_s = 1.5;
    return inputs;
}

// A frame as a viewer has it: without the linear picture.
void drawPlain(render::ViewRenderer& view, const FrameInputs& inputs) {
    ASSERT_TRUE(view.submit(inputs));
    ASSERT_TRUE(view.collect());
}

// The room with nothing but a rough untextured floor, wall and boxes, and no light of its own.
scene::Scene bareRoom() {
    auto scene = makeRoom();
    scene.images.clear();
    scene.textures.clear();
    scene.samplers.clear();
    for (auto& material : scene.materials) {
        material = {};
        material.metallic = 0;
    }
    return scene;
}

template <class Test>
bool anyPipeline(render::Renderer& renderer, Test test) {
    const auto made = renderer.resources().shared.variantsMade();
    return std::any_of(made.begin(), made.end(), test);
}

bool anyMaterialFlag(render::Renderer& renderer, render::MaterialFlags flags) {
    return anyPipeline(renderer,
                       [&](const auto& made) { return (made.key.material_flags & flags) != 0; });
}

bool anyLightFlag(render::Renderer& renderer, uint32_t flags) {
    return anyPipeline(renderer,
                       [&](const auto& made) { return (made.key.light_flags & flags) != 0; });
}

// The same frames by the specialised and by the generic variants; without `each` only by those two
// that have every part between them.
void expectPartsNeutral(render::Renderer& renderer,
                        const scene::Scene& scene,
                        uint32_t lights,
                        bool each) {
    const std::array<std::pair<const char*, GenericParts>, 8> parts = {
        {{"plain loops", {.plain_loops = true}},
         {"everything",
          {.spots = true,
           .directional = true,
           .wide_gbuffer = true,
           .transparent = true,
           .uneven_radii = true,
           .uncut_loops = true}},
         {"spots", {.spots = true}},
         {"directional", {.directional = true}},
         {"wide G-buffer", {.wide_gbuffer = true}},
         {"blending", {.transparent = true}},
         {"uneven radii", {.uneven_radii = true}},
         {"uncut loops", {.uncut_loops = true}}}};
    for (const auto kind : kAllRenderers) {
        FrameInputs inputs = inputsFor(scene, kind, lights);
        const Picture special = draw(renderer, inputs);
        for (const auto& [name, part] : std::span(parts).first(each ? parts.size() : 2)) {
            SCOPED_TRACE(std::string(settings::kRendererNames[static_cast<size_t>(kind)]) + ", " +
                         name);
            inputs.generic = part;
            const Picture generic = draw(renderer, inputs);
            EXPECT_EQ(differingFloats(special, generic), 0U);
            EXPECT_EQ(special.rgba8, generic.rgba8);
        }
    }
}

// Pictures of two scenes that should look alike by all renderers.
void expectScenesAlike(gpu::Device& device,
                       const scene::Scene& lean,
                       const scene::Scene& generic,
                       render::MaterialFlags generic_flags) {
    render::Renderer a(device, lean);
    render::Renderer b(device, generic);
    for (const auto kind : kAllRenderers) {
        const auto inputs = inputsFor(lean, kind, 40);
        EXPECT_EQ(differingFloats(draw(a, inputs), draw(b, inputs)), 0U)
            << settings::kRendererNames[static_cast<size_t>(kind)];
    }
    EXPECT_FALSE(anyMaterialFlag(a, generic_flags));
    EXPECT_TRUE(anyMaterialFlag(b, generic_flags));
}

} // namespace

// A coat of no strength, whatever else it has.
TEST_F(Variants, CoatOfNoStrength_GivesTheSamePicture) {
    const auto lean = makeRoom();
    auto neutral = lean;
    giveCoats(neutral);
    auto coated = neutral;
    for (auto& material : neutral.materials) {
        material.coat.strength = 0;
    }
    render::Renderer a(device(), lean);
    render::Renderer b(device(), neutral);
    render::Renderer c(device(), coated);
    for (const auto kind : kAllRenderers) {
        auto inputs = inputsFor(lean, kind, 40);
        const Picture expected = draw(a, inputs);
        EXPECT_EQ(differingFloats(expected, draw(b, inputs)), 0U);
        EXPECT_NE(differingFloats(expected, draw(c, inputs)), 0U);
        inputs.settings.shading = settings::ShadingModel::kLambert; // which has none
        EXPECT_EQ(differingFloats(draw(a, inputs), draw(c, inputs)), 0U);
    }
    EXPECT_FALSE(anyMaterialFlag(b, render::kLayerFlags));
    EXPECT_TRUE(anyMaterialFlag(c, render::kLayerFlags));
}

// As many textures in a shader as surfaces take, and not one for what is over them.
TEST_F(Variants, DeviceOfFewTextures_DrawsWithoutLayers) {
    const auto lean = makeRoom();
    auto coated = lean;
    giveCoats(coated);
    gpu::DeviceOptions options;
    options.most_textures = render::kPassTextures + io::kMaterialSlots - 1;
    openDevice(options);
    {
        render::Renderer a(device(), lean);
        render::Renderer b(device(), coated);
        for (const auto kind : kAllRenderers) {
            const auto inputs = inputsFor(lean, kind, 40);
            EXPECT_EQ(differingFloats(draw(a, inputs), draw(b, inputs)), 0U);
        }
        EXPECT_FALSE(b.resources().needs.layers);
    }
    options.most_textures = render::kPassTextures + io::kSurfaceSlots - 1;
    openDevice(options);
    EXPECT_THROW(render::Renderer(device(), lean), StartupError);
}

TEST_F(Variants, NothingAtAll_AllocatesAndCompilesNothingForIt) {
    const auto scene = bareRoom();
    for (const bool by_ids : {false, true}) {
        SCOPED_TRACE(by_ids);
        render::Renderer renderer(device(), scene);
        render::ViewRenderer view(renderer);
        auto inputs = inputsFor(scene, Renderer::kClusteredDeferred, 0);
        inputs.geometry =
            by_ids ? render::GeometryPath::kVisibility : render::GeometryPath::kRaster;
        drawPlain(view, inputs);
        const auto purposes = memory();
        EXPECT_EQ(purposes.contains("visible ids"), by_ids);
        for (const char* absent :
             {"textures", "extended vertices", "radiance", "staging", "lights", "light lists"}) {
            EXPECT_THAT(purposes, Not(Contains(Key(absent)))) << absent;
        }
        EXPECT_FALSE(anyMaterialFlag(renderer, ~0U));
        EXPECT_FALSE(anyLightFlag(renderer, ~0U));
        auto made = renderer.resources().shared.variantsMade();
        std::ranges::sort(made, {}, &render::Pipelines::Made::pass);
        ASSERT_EQ(made.size(), 2U);
        EXPECT_EQ(made[by_ids ? 1 : 0].pass, by_ids ? "visibility gbuffer" : "gbuffer");
        EXPECT_EQ(made[by_ids ? 0 : 1].pass, "lighting");
        EXPECT_EQ(made[by_ids ? 1 : 0].key.output_flags & io::kOutputWideGbuffer, 0U);
    }
}

TEST_F(Variants, ForwardRenderer_HasNoGbuffer) {
    const auto scene = bareRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    drawPlain(view, inputsFor(scene, Renderer::kForwardPlus, 5));
    EXPECT_THAT(memory(), Not(Contains(Key("gbuffer"))));
    EXPECT_FALSE(anyPipeline(renderer, [](const auto& m) { return m.pass == "gbuffer"; }));
}

TEST_F(Variants, PointLightsOfOneRadius_CompileNoConesNoRadiiNoSuns) {
    const auto scene = bareRoom();
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    for (const auto kind : kAllRenderers) {
        drawPlain(view, inputsFor(scene, kind, 30));
    }
    EXPECT_FALSE(anyLightFlag(renderer, io::kLightSpots | io::kLightDirectional));
    EXPECT_FALSE(anyPipeline(renderer, [](const auto& m) {
        const uint32_t flags = m.key.light_flags;
        return (flags & io::kLightLocal) != 0 && (flags & io::kLightEqualRadii) == 0;
    }));
}

TEST_F(Variants, FullRoom_CompilesEachPartOnlyWhereItIs) {
    const auto scene = makeRoom(); // masks, glass, normal maps, metal, emission
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    drawPlain(view, inputsFor(scene, Renderer::kClusteredDeferred, 30));
    EXPECT_TRUE(anyMaterialFlag(renderer, io::kMaterialMask));
    EXPECT_TRUE(anyPipeline(renderer, [](const auto& m) { return m.pass == "transparent"; }));
    EXPECT_FALSE(anyMaterialFlag(renderer, io::kMaterialExtended | io::kMaterialUnlit |
                                               io::kMaterialUvTransform));
    EXPECT_THAT(memory(), Contains(Key("radiance"))); // blending needs it
    EXPECT_THAT(memory(), Not(Contains(Key("extended vertices"))));
    auto without_glass = scene;
    std::erase_if(without_glass.instances, [](const auto& i) { return i.mesh == 3; });
    render::Renderer other(device(), without_glass);
    render::ViewRenderer other_view(other);
    drawPlain(other_view, inputsFor(scene, Renderer::kClusteredDeferred, 30));
    EXPECT_FALSE(anyPipeline(
        other, [](const auto& m) { return m.pass == "transparent" || m.pass == "tonemap"; }));
}

TEST_F(Variants, UnlitMaterial_LoadsNoTextureThatItDoesNotShow) {
    auto scene = makeRoom();
    for (auto& material : scene.materials) {
        material.unlit = true;
        material.base_color_texture = {};
    }
    const render::Renderer renderer(device(), scene);
    EXPECT_THAT(memory(), Not(Contains(Key("textures"))));
}

TEST_F(Variants, Memory_DetailsAreTheLedgersAndGoWithTheirOwners) {
    const auto scene = makeRoom();
    {
        render::Renderer renderer(device(), scene);
        render::ViewRenderer view(renderer);
        const auto inputs = inputsFor(scene, Renderer::kClusteredDeferred, 30);
        ASSERT_TRUE(view.submit(inputs));
        const auto frame = view.collect();
        ASSERT_TRUE(frame);
        ASSERT_TRUE(frame->stats.details);
        uint64_t sum = 0;
        for (const auto& use : frame->stats.details->memory) {
            sum += use.bytes;
        }
        EXPECT_EQ(sum, device().memoryLedger()->totalBytes());
        EXPECT_THAT(frame->stats.details->plan,
                    Contains("transparent surfaces in view: sorted and blended"));
    }
    EXPECT_EQ(device().memoryLedger()->totalBytes(), 0U);
}

TEST_F(Variants, EveryPart_Room_GivesTheSameBits) {
    auto scene = makeRoom();
    render::Renderer renderer(device(), scene);
    expectPartsNeutral(renderer, scene, 60, true);
}

TEST_F(Variants, EveryPart_BareRoom_GivesTheSameBits) {
    const auto scene = bareRoom();
    render::Renderer renderer(device(), scene);
    expectPartsNeutral(renderer, scene, 60, true);
}

TEST_F(Variants, AllParts_BuiltinScene_GiveTheSameBits) {
    const auto scene = builtin_scene::makeHall();
    render::Renderer renderer(device(), scene);
    expectPartsNeutral(renderer, scene, 200, wholeGrids());
}

TEST_F(Variants, AllParts_Sponza_GiveTheSameBits) {
    const auto scene = loadSponza();
    if (!scene) {
        GTEST_SKIP() << "Sponza is not here: set FROXEL_SPONZA to its .gltf file";
    }
    render::Renderer renderer(device(), *scene);
    expectPartsNeutral(renderer, *scene, 300, wholeGrids());
}

TEST_F(Variants, MaskThatKeepsEverything_GivesTheSameBits) {
    const auto lean = bareRoom();
    auto generic = lean;
    for (auto& material : generic.materials) {
        material.alpha_mode = scene::AlphaMode::kMask;
    }
    expectScenesAlike(device(), lean, generic, io::kMaterialMask);
}

// Not the base colour's: llvmpipe decodes sRGB by a polynomial, and white comes out a bit darker.
TEST_F(Variants, WhiteTextures_GiveTheSameBits) {
    const auto lean = bareRoom();
    auto generic = lean;
    generic.images = {{"white", 1, 1, std::vector<std::byte>(4, std::byte{255})}};
    generic.textures = {{0, scene::kNone}};
    for (auto& material : generic.materials) {
        material.metallic_roughness_texture.texture = 0;
        material.occlusion_texture.texture = 0;
    }
    expectScenesAlike(device(), lean, generic,
                      render::textureFlag(io::metallic_roughness_slot) |
                          render::textureFlag(io::occlusion_slot));
}

} // namespace froxel::test

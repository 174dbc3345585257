// Material variants: each shows, to the bit, what a scene with its materials shows.
#include "render/scene/scene_resources.h"
#include "scene/material_variants.h"
#include "scene/motion.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/test_scenes.h"

#include <array>
#include <memory>

namespace froxel::test {

namespace {

using render::FrameInputs;
using render::GeometryPath;
using settings::LightingStage;
using settings::Renderer;

class MaterialVariants : public GpuTest {};

uint32_t add(scene::Scene& scene, const scene::Material& material) {
    scene.materials.push_back(material);
    return static_cast<uint32_t>(scene.materials.size() - 1);
}

// The room in two more dresses. In the first its surfaces change places with others of every kind:
// metal that glows, glass, holes. In the second half of them are unlit, the others as they were.
scene::Scene dressedRoom() {
    scene::Scene room = makeRoom();
    scene::Material metal;
    metal.emissive = {0.2F, 0.1F, 0};
    scene::Material glass;
    glass.base_color = {0.2F, 0.9F, 0.4F, 0.5F};
    glass.alpha_mode = scene::AlphaMode::kBlend;
    scene::Material holes;
    holes.base_color = {0.8F, 0.8F, 0.1F, 0.3F};
    holes.alpha_mode = scene::AlphaMode::kMask;
    holes.alpha_cutoff = 0.2F;
    holes.metallic = 0;
    holes.double_sided = true;
    scene::Material flat;
    flat.base_color = {0.3F, 0.3F, 0.9F, 1};
    flat.unlit = true;
    const std::array swapped = {add(room, metal), add(room, glass), add(room, holes)};
    const uint32_t unlit = add(room, flat);
    room.material_variants = {"swapped", "half unlit"};
    uint32_t count = 0;
    for (scene::Mesh& mesh : room.meshes) {
        for (scene::Primitive& primitive : mesh.primitives) {
            primitive.variant_materials.push_back({0, swapped[count % swapped.size()]});
            if (count % 2 == 0) {
                primitive.variant_materials.push_back({1, unlit});
            }
            ++count;
        }
    }
    return room;
}

FrameInputs inputsFor(const scene::Scene& scene) {
    FrameInputs inputs;
    inputs.settings.camera = scene.cameras[0].camera;
    inputs.settings.size = {120, 68};
    inputs.settings.lights.count = 20;
    inputs.settings.shadows.light_count = 2;
    inputs.time_s = 1.5;
    return inputs;
}

// By fragments, by ids in a forward renderer, and by a G-buffer.
std::vector<FrameInputs> ways(const scene::Scene& scene) {
    FrameInputs forward = inputsFor(scene);
    forward.settings.renderer = Renderer::kForwardPlus;
    FrameInputs by_ids = forward;
    by_ids.settings.lighting = LightingStage::kCompute;
    FrameInputs deferred = inputsFor(scene);
    deferred.settings.renderer = Renderer::kClusteredDeferred;
    deferred.geometry = GeometryPath::kVisibility;
    return {forward, by_ids, deferred};
}

} // namespace

TEST_F(MaterialVariants, Each_IsTheSceneWithItsMaterials) {
    const scene::Scene room = dressedRoom();
    render::Renderer all(device(), room);
    render::ViewRenderer view(all);
    for (const uint32_t number : {0U, 1U, 2U}) {
        render::Renderer one(device(), scene::inMaterialVariant(room, number));
        for (FrameInputs inputs : ways(room)) {
            const Picture wanted = draw(one, inputs);
            inputs.settings.material_variant = number;
            const Picture got = draw(view, inputs);
            EXPECT_EQ(differingFloats(got, wanted), 0U) << number;
            EXPECT_EQ(got.rgba8, wanted.rgba8) << number;
        }
    }
}

// A view goes over to another while frames of the one before are on the device, and nobody else
// holds it; what was kept of surfaces and shadows is not shown in the wrong dress.
TEST_F(MaterialVariants, Changed_BetweenFramesOnTheDevice) {
    const scene::Scene room = dressedRoom();
    render::Renderer renderer(device(), room);
    for (FrameInputs inputs : ways(room)) {
        inputs.keep_surfaces = true;
        std::vector<std::vector<std::byte>> wanted;
        for (const uint32_t number : {0U, 1U, 2U}) {
            render::ViewRenderer fresh(renderer);
            inputs.settings.material_variant = number;
            wanted.push_back(drawPixels(fresh, inputs).rgba8);
        }
        EXPECT_NE(wanted[0], wanted[1]);
        EXPECT_NE(wanted[0], wanted[2]);
        render::ViewRenderer view(renderer);
        constexpr std::array kOrder = {1U, 2U, 0U, 0U, 2U, 2U, 1U};
        size_t collected = 0;
        const auto collect = [&] {
            EXPECT_EQ(collectPixels(view).rgba8, wanted[kOrder[collected]]) << collected;
            ++collected;
        };
        for (const uint32_t number : kOrder) {
            while (!view.canSubmit()) {
                collect();
            }
            inputs.settings.material_variant = number;
            ASSERT_TRUE(view.submit(inputs));
        }
        while (view.inFlight() > 0) {
            collect();
        }
        EXPECT_EQ(collected, kOrder.size());
    }
}

TEST_F(MaterialVariants, OfASceneThatMoves_MoveWithIt) {
    scene::Scene room = dressedRoom();
    scene::Motion motion;
    motion.nodes.resize(1);
    motion.instances = {{1, 0, room.instances[1].world_from_object, scene::kNone}};
    const scene::Track track{scene::Interpolation::kLinear, 3, {0, 2}, {0, 0, 0, 0, 0.5F, 0}};
    motion.clips = {{"lift", 2, {track}, {{0, 0, scene::ChannelPath::kTranslation}}}};
    room.motion = std::make_shared<const scene::Motion>(motion);
    render::Renderer all(device(), room);
    render::ViewRenderer view(all);
    render::Renderer one(device(), scene::inMaterialVariant(room, 1));
    FrameInputs inputs = ways(room)[0];
    inputs.settings.material_variant = 2;
    std::ignore = draw(view, inputs);
    inputs.settings.material_variant = 1;
    for (const double time_s : {1.5, 0.25}) {
        inputs.time_s = time_s;
        const Picture got = draw(view, inputs);
        EXPECT_EQ(differingFloats(got, draw(one, inputs)), 0U) << time_s;
    }
}

TEST_F(MaterialVariants, MaterialSet_GoesWithTheLastWhoHoldsIt) {
    const scene::Scene room = dressedRoom();
    render::Renderer renderer(device(), room);
    auto& resources = renderer.resources();
    std::weak_ptr<render::MaterialSet> seen;
    {
        render::ViewRenderer first(renderer);
        render::ViewRenderer second(renderer);
        FrameInputs inputs = ways(room)[1];
        inputs.settings.material_variant = 1;
        std::ignore = draw(first, inputs);
        std::ignore = draw(second, inputs);
        seen = resources.materialsOfVariant(1);
        EXPECT_EQ(seen.use_count(), 4) << "two views, each with a frame drawn in it";
        EXPECT_TRUE(seen.lock()->needs.blended);
        EXPECT_FALSE(resources.materialsOfVariant(2)->needs.layers);
    }
    EXPECT_TRUE(seen.expired());
    EXPECT_EQ(resources.materialsOfVariant(0), resources.materialsOfVariant(0));
}

} // namespace froxel::test

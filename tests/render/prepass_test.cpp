// The depth prepass spares work where surfaces overlap and never changes the picture.
#include "builtin_scene/hall.h"
#include "render/scene/scene_resources.h"
#include "support/draw.h"
#include "support/gpu_fixture.h"
#include "support/test_scenes.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <string_view>

namespace froxel::test {

namespace {

using settings::Renderer;

class Prepass : public SharedGpuTest {};

bool has(const Picture& picture, std::string_view pass) {
    const auto& passes = picture.stats.passes;
    return std::any_of(passes.begin(), passes.end(),
                       [&](const PassTime& time) { return time.name == pass; });
}

render::FrameInputs inputsFor(const scene::Scene& scene, Renderer renderer) {
    render::FrameInputs inputs;
    inputs.settings.camera = scene.cameras.front().camera;
    inputs.settings.size = {160, 90};
    inputs.settings.renderer = renderer;
    inputs.settings.lights.count = 100;
    inputs.geometry = render::GeometryPath::kRaster;
    return inputs;
}

void expectSamePictures(gpu::Device& device, const scene::Scene& scene) {
    render::Renderer renderer(device, scene);
    render::ViewRenderer view(renderer);
    for (const auto kind : {Renderer::kForwardPlus, Renderer::kClusteredDeferred,
                            Renderer::kToonFragment, Renderer::kToonCompute}) {
        auto inputs = inputsFor(scene, kind);
        inputs.depth_prepass = false;
        const Picture at_once = draw(view, inputs);
        inputs.depth_prepass = true;
        const Picture after_depth = draw(view, inputs);
        EXPECT_FALSE(has(at_once, "depth_prepass"));
        EXPECT_TRUE(has(after_depth, "depth_prepass"));
        EXPECT_EQ(differingFloats(at_once, after_depth), 0U)
            << settings::kRendererNames[static_cast<size_t>(kind)];
    }
}

// Squares that cross in the picture's vertical middle line, like the leaves of a book seen from
// above its spine. Their middles are equally far, so they are drawn in file order: on one side of
// the line near ones first, on the other far ones.
scene::Scene leaves(uint32_t count) {
    scene::Scene scene;
    scene.materials.emplace_back().double_sided = true;
    scene::Primitive square;
    for (const auto& corner :
         {glm::vec2(-9, -9), glm::vec2(9, -9), glm::vec2(9, 9), glm::vec2(-9, 9)}) {
        square.positions.emplace_back(corner, 0);
        square.normals.emplace_back(0, 0, 1);
        square.bounds.add(square.positions.back());
    }
    square.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes.push_back({.name = "square", .primitives = {square}});
    for (uint32_t i = 0; i < count; ++i) {
        const double turn = count < 2 ? 0.0 : 1.0 * i / (count - 1) - 0.5;
        auto& placed = scene.instances.emplace_back();
        placed.world_from_object =
            glm::rotate(glm::translate(glm::dmat4(1), {0, 0, -5}), turn, {0, 1, 0});
    }
    scene.bounds_world.add(glm::dvec3(-9, -9, -10));
    scene.bounds_world.add(glm::dvec3(9, 9, 0));
    scene.cameras.push_back({.name = "front", .camera = {}});
    return scene;
}

} // namespace

TEST_F(Prepass, Room_AnyRenderer_GivesTheSameBits) {
    expectSamePictures(device(), makeRoom());
}

TEST_F(Prepass, Hall_AnyRenderer_GivesTheSameBits) {
    expectSamePictures(device(), builtin_scene::makeHall());
}

TEST_F(Prepass, Overdraw_OneSurface_IsMeasuredByTheFirstFrame) {
    const auto scene = leaves(1);
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    EXPECT_FALSE(renderer.resources().overdraw);
    auto inputs = inputsFor(scene, Renderer::kClusteredDeferred);
    (void)draw(view, inputs);
    ASSERT_TRUE(renderer.resources().overdraw);
    EXPECT_DOUBLE_EQ(*renderer.resources().overdraw, 1);
}

TEST_F(Prepass, ManyLayersOfFewTriangles_AreShadedOnce) {
    const auto scene = leaves(30);
    render::Renderer renderer(device(), scene);
    render::ViewRenderer view(renderer);
    auto inputs = inputsFor(scene, Renderer::kClusteredDeferred);
    const Picture first = draw(view, inputs);
    EXPECT_FALSE(has(first, "depth_prepass"));
    EXPECT_GT(renderer.resources().overdraw.value_or(0), 10);
    const Picture second = draw(view, inputs);
    EXPECT_TRUE(has(second, "depth_prepass"));
    EXPECT_EQ(differingFloats(first, second), 0U);
    inputs.settings.renderer = Renderer::kNaive;
    EXPECT_FALSE(has(draw(view, inputs), "depth_prepass"));
}

} // namespace froxel::test

// Shadow maps where they are hard: lists stay exact, values finite and memory as asked for.
#include "render/steps/shadows.h"
#include "support/exact.h"
#include "support/gpu_fixture.h"
#include "support/shapes.h"
#include "support/test_scenes.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace froxel::test {

namespace {

using glm::dvec3;

class HardShadows : public SharedGpuTest {};

SceneMaker boxWithABall() {
    auto maker = insideOfABox(3);
    maker.add(sphere(0.5F, 8, 0), glm::translate(glm::dmat4(1), dvec3(0.4, -0.3, -1.6)));
    return maker;
}

} // namespace

TEST_F(HardShadows, MoreLightsThanMaps_AreExact) {
    const auto maker = boxWithABall();
    render::Renderer renderer(device(), maker.scene);
    auto inputs = hardInputs();
    inputs.settings.lights.count = 300;
    inputs.settings.lights.radius_m = 2.5F;
    for (const settings::Shadows shadows :
         {settings::Shadows{1, 512}, {8, 64}, {9, 65}, {32, 64}}) {
        inputs.settings.shadows = shadows;
        const auto pictures = expectExact(renderer, inputs);
        EXPECT_EQ(pictures.naive.stats.steps.count("shadows", "lights"), shadows.light_count);
        EXPECT_EQ(pictures.naive.stats.steps.count("shadows", "maps"), 6 * shadows.light_count);
    }
}

// In a wall, on a wall, at the eye, on a cube's diagonal, inside a closed ball, outside the scene,
// without range, tiny and huge.
TEST_F(HardShadows, LightsAnywhere_AreExactAndFinite) {
    auto maker = boxWithABall();
    maker.point({3, 0.1, -1}, 2).point({-3 + 1e-6, -0.2, -1}, 3).point({0, 0, 0}, 3);
    maker.point({-1, -1, -1}, 4).point({0.4, -0.3, -1.6}, 3, 100).point({9, 0, 0}, 8, 50);
    maker.point({0, 1, -2}, 0).point({0.5, 2, -1}, 0.002F).point({-2, 2, -2}, 1e4F);
    maker.spot({0, 2, -1}, {0, -1, 0}, 6, 0, 0.01).spot({1, 2, -1}, {1, 1, 1}, 0, 10, 60);
    maker.spot({-1, 2, -1}, {0, -1, -1}, 6, 80, 90).spot({0, 2, -2}, {0, -1, 0}, 6, 100, 180);
    render::Renderer renderer(device(), maker.scene);
    auto inputs = hardInputs();
    inputs.settings.shadows = {32, 100};
    const auto pictures = expectExact(renderer, inputs);
    EXPECT_GT(litPixels(pictures.naive), 500U);
    EXPECT_GE(pictures.naive.stats.steps.count("shadows", "lights"), 11U);
}

// A thousand kilometres away maps and picture are those of the origin, but for the rounding of
// positions to a ten-billionth of a metre.
TEST_F(HardShadows, AThousandKilometresAway_ShadowsAreTheSame) {
    const auto depthsAt = [&](const dvec3& offset) {
        auto maker = boxWithABall();
        maker.point({0.3, 1.2, -0.9}, 5, 4);
        for (auto& instance : maker.scene.instances) {
            instance.world_from_object[3] += glm::dvec4(offset, 0);
        }
        maker.scene.lights[0].position_world += offset;
        maker.scene.bounds_world.min += offset;
        maker.scene.bounds_world.max += offset;
        render::Renderer renderer(device(), maker.scene);
        render::ViewRenderer view(renderer);
        auto inputs = hardInputs();
        inputs.settings.camera.eye_world = offset;
        inputs.settings.shadows = {1, 128};
        (void)draw(view, inputs);
        return render::copyShadows(view.steps()).depths;
    };
    const auto here = depthsAt({0, 0, 0});
    const auto there = depthsAt({1e6, -1e6, 1e6});
    ASSERT_EQ(here.size(), there.size());
    size_t apart = 0;
    for (size_t i = 0; i < here.size(); ++i) {
        apart += std::abs(here[i] - there[i]) > 1e-5F * here[i] ? 1U : 0U;
    }
    EXPECT_LT(apart, here.size() / 1000); // edges that snap to the next 1/256 of a texel
}

// Mirrored, squashed and vanishing instances, thin and far: whatever culling makes of them.
TEST_F(HardShadows, TurnedAndSquashedCasters_CastAsTheyAreSeen) {
    auto maker = wallAhead(4);
    const auto at = [](const dvec3& position, const dvec3& scale) {
        return glm::scale(glm::translate(glm::dmat4(1), position), scale);
    };
    maker.add(sphere(0.5F, 12, 0), at({0, 0, -2}, {-1, 1, 1}));
    maker.add(sphere(0.5F, 12, 0), at({1, 0.4, -3}, {0.01, 1, 1}));
    maker.add(sphere(0.5F, 12, 0), at({-1, 0.4, -3}, {0, 0, 0}));
    maker.point({0.1, 0.2, 0.5}, 12, 20);
    render::Renderer renderer(device(), maker.scene);
    auto inputs = hardInputs();
    inputs.settings.shadows = {1, 512};
    const auto pictures = expectExact(renderer, inputs);
    // Behind the ball, as seen from beside the light, the wall is dark.
    EXPECT_GT(litPixels(pictures.naive), 64U * 36 / 2);
    EXPECT_LT(litPixels(pictures.naive), 64U * 36);
}

TEST_F(HardShadows, SettingsThatComeAndGo_LeaveNoTrace) {
    const auto maker = boxWithABall();
    render::Renderer renderer(device(), maker.scene);
    render::ViewRenderer view(renderer);
    auto inputs = hardInputs();
    inputs.settings.lights.count = 60;
    inputs.settings.lights.radius_m = 4;
    const settings::Shadows ways[] = {{0, 256}, {3, 64}, {3, 128}, {20, 64}, {1, 512}};
    std::vector<Picture> fresh;
    for (const auto& shadows : ways) {
        inputs.settings.shadows = shadows;
        fresh.push_back(draw(renderer, inputs));
    }
    for (const size_t i : {1U, 3U, 0U, 2U, 4U, 0U, 1U, 4U, 3U}) {
        inputs.settings.shadows = ways[i];
        EXPECT_EQ(differingFloats(draw(view, inputs), fresh[i]), 0U) << i;
    }
    EXPECT_GT(differingFloats(fresh[0], fresh[3]), 0U);
}

} // namespace froxel::test

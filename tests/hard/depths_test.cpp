// Depths: at slices' planes, at the near plane, very far, nowhere; and steps from near to far.
#include "cluster/cluster_grid.h"
#include "light/light_rig.h"
#include "render/lists/light_grid.h"
#include "settings/environment.h"
#include "support/exact.h"
#include "support/gpu_fixture.h"
#include "support/oracle.h"
#include "support/shapes.h"

#include <bit>
#include <cmath>

namespace froxel::test {

namespace {

using glm::dvec3;

class HardDepths : public SharedGpuTest {};

float ulpsOn(float value, int ulps) {
    return std::bit_cast<float>(std::bit_cast<int32_t>(value) + ulps);
}

// A tile of a wall at `depth` that covers column `x` and row `y` of columns x rows over the view of
// hardInputs().
scene::Primitive patch(float depth, uint32_t x, uint32_t y, uint32_t columns, uint32_t rows) {
    const double half_y = std::tan(glm::radians(30.0)) * static_cast<double>(depth);
    const double half_x = half_y * 64 / 36;
    const glm::vec3 corner(half_x * (2.0 * x / columns - 1), half_y * (1 - 2.0 * (y + 1) / rows),
                           -depth);
    const auto width = static_cast<float>(2 * half_x / columns);
    const auto height = static_cast<float>(2 * half_y / rows);
    return quad(corner, {width, 0, 0}, {0, height, 0}, 1, 0);
}

// The planes between the slices of the frame's grid.
std::vector<float> slicePlanes(const scene::Scene& scene, const render::FrameInputs& inputs) {
    light::FrameLights lights;
    light::LightRig(scene).evaluate(inputs.settings.lights, inputs.settings.camera, 0, lights);
    render::LightGrid grid;
    auto settings = inputs.settings;
    settings.renderer = settings::Renderer::kForwardPlus;
    grid.choose(settings, lights, scene.bounds_world, cluster::Lit::kSurfaces, cluster::kCpuCosts);
    return grid.grid().plane_depths_m;
}

} // namespace

// Case 15. Patches that face the eye at each plane between slices, and 1 and 40 floats off it.
TEST_F(HardDepths, SurfacesOnSlicePlanes_AreExact) {
    constexpr int kUlps[] = {-40, -1, 0, 1, 40};
    for (const auto law : {settings::GridLaw::kLogarithmic, settings::GridLaw::kLinear,
                           settings::GridLaw::kHyperbolic}) {
        SCOPED_TRACE(static_cast<int>(law));
        auto inputs = hardInputs();
        inputs.settings.grid = {.automatic = false, .size = {4, 3, 16}, .law = law};
        inputs.settings.lights.count = 200;
        inputs.settings.lights.radius_m = 0.7F;
        inputs.settings.lights.box = BoundsD3{{-4, -3, -12}, {4, 3, -0.2}};
        SceneMaker maker;
        maker.scene.bounds_world = {{-10, -10, -12}, {10, 10, 0}};
        const auto planes = slicePlanes(maker.scene, inputs);
        ASSERT_EQ(planes.size(), 17U);
        for (uint32_t k = 1; k < 17; ++k) {
            for (uint32_t i = 0; i < 5; ++i) {
                maker.add(patch(ulpsOn(planes[k], kUlps[i]), k - 1, i, 16, 5));
            }
        }
        maker.scene.bounds_world = {{-10, -10, -12}, {10, 10, 0}};
        ASSERT_EQ(planes, slicePlanes(maker.scene, inputs));
        render::Renderer renderer(device(), maker.scene);
        const auto pictures = expectExact(renderer, inputs, Toon::kNo);
        EXPECT_GT(litPixels(pictures.naive), 100U);
        expectNoneMissing(maker.scene, inputs, refer(renderer, maker.scene, inputs).visibility);
    }
}

// Case 16. On the near plane, a thousand kilometres off beyond every light, and nothing at all.
TEST_F(HardDepths, NearFarAndSky_AreFiniteAndTheSkyIsUntouched) {
    auto inputs = hardInputs();
    const auto near_m = static_cast<float>(inputs.settings.camera.near_m);
    SceneMaker maker;
    maker.add(patch(near_m * (1 + 1e-6F), 0, 0, 4, 1));
    maker.add(patch(1e6F, 1, 0, 4, 1));
    maker.add(patch(3, 2, 0, 4, 1));
    maker.point({0.5, 0, -2.5}, 3).point({-0.03, 0, -0.04}, 0.2F).point({0, 0, -0.9e6}, 0, 1e12F);
    render::Renderer renderer(device(), maker.scene);
    const auto pictures = expectExact(renderer, inputs);
    for (const Picture* picture : {&pictures.naive, &pictures.deferred}) {
        for (uint32_t y = 0; y < 36; ++y) {
            for (uint32_t x = 49; x < 64; ++x) {
                for (uint32_t c = 0; c < 3; ++c) {
                    ASSERT_EQ(at(*picture, x, y, c), 0);
                }
            }
        }
        EXPECT_GT(at(*picture, 8, 18, 0), 0.0F);
        EXPECT_GT(at(*picture, 24, 18, 0), 0.0F);
        EXPECT_GT(at(*picture, 40, 18, 0), 0.0F);
    }
    expectNoneMissing(maker.scene, inputs, refer(renderer, maker.scene, inputs).visibility);
}

// Case 17. Near planes from 1 mm to 10 m before surfaces up to 1,000 km away. A depth is near over
// distance: a division, a plane's evaluation and a store, each half an ulp, and one for the vertex.
TEST_F(HardDepths, ExtremeNearAndFar_KeepTheirDistances) {
    for (const double near_m : {1e-3, 0.1, 10.0}) {
        for (const double far_m : {10.0, 1e3, 1e5, 1e6}) {
            if (far_m <= near_m) {
                continue;
            }
            SCOPED_TRACE(std::to_string(near_m) + " to " + std::to_string(far_m));
            SceneMaker maker;
            std::vector<float> distances;
            for (uint32_t i = 0; i < 8; ++i) {
                const double step = std::pow(far_m / near_m, i / 7.0);
                distances.push_back(static_cast<float>(near_m * step * (1 + 1e-6)));
                maker.add(patch(distances.back(), i, 0, 8, 1));
                const auto d = static_cast<double>(distances.back());
                maker.point({d * (i / 4.0 - 0.9), 0, -0.9 * d}, distances.back());
            }
            render::Renderer renderer(device(), maker.scene);
            auto inputs = hardInputs();
            inputs.settings.camera.near_m = near_m;
            (void)expectExact(renderer, inputs, Toon::kNo);
            const auto reference = refer(renderer, maker.scene, inputs);
            expectNoneMissing(maker.scene, inputs, reference.visibility);
            for (uint32_t i = 0; i < 8; ++i) {
                const float depth = reference.visibility.depths[size_t{18} * 64 + i * 8 + 4];
                const double distance = near_m / static_cast<double>(depth);
                EXPECT_NEAR(distance / static_cast<double>(distances[i]), 1, 4 * 0x1p-24) << i;
            }
        }
    }
}

// One floor of two triangles from under the eye to the horizon: nearest and farthest depths are
// 1 : 1e5 apart within a triangle.
TEST_F(HardDepths, FloorToTheHorizon_KeepsItsDistances) {
    SceneMaker maker;
    maker.add(quad({-3e4F, -1, 1}, {6e4F, 0, 0}, {0, 0, -3e4F}, 1, 0));
    for (double z = 1; z < 3e4; z *= 1.7) {
        maker.point({0.3 * z, -1 + 0.3 * z, -z}, static_cast<float>(z), static_cast<float>(z * z));
    }
    render::Renderer renderer(device(), maker.scene);
    const auto inputs = hardInputs();
    const auto pictures = expectExact(renderer, inputs, Toon::kNo);
    const auto reference = refer(renderer, maker.scene, inputs);
    expectNoneMissing(maker.scene, inputs, reference.visibility);
    // The farthest row sees the floor 62 m away; a light is a third of its distance off.
    for (const auto& picture : {pictures.naive, drawByPlanes(renderer, inputs)}) {
        const auto worst = worstOf(picture, reference, within(1e-4, 1e-6));
        EXPECT_LE(worst.ratio, 1) << worst;
    }
}

// Case 35. A fence before a far wall: depths of a tile from end to end.
TEST_F(HardDepths, FenceBeforeAFarWall_IsExactAndItsListsStayShort) {
    auto maker = wallAhead(40);
    for (float x = -1.2F; x < 1.2F; x += 0.12F) {
        maker.add(quad({x, -1, -1}, {0.04F, 0, 0}, {0, 2, 0}, 1, 0));
    }
    render::Renderer renderer(device(), maker.scene);
    auto inputs = hardInputs();
    inputs.settings.lights.count = 1000;
    inputs.settings.lights.radius_m = 1;
    inputs.settings.lights.box = BoundsD3{{-20, -12, -40}, {20, 12, -0.5}};
    const auto pictures = expectExact(renderer, inputs);
    const auto reference = refer(renderer, maker.scene, inputs);
    expectNoneMissing(maker.scene, inputs, reference.visibility);
    // A tile's range from fence to wall would list what floats between; a cluster's does not.
    EXPECT_LT(pictures.forward_plus.stats.lists.p95, 100U);
}

} // namespace froxel::test

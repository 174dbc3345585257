// A medium where lights, eye, scene and depths are at their worst.
#include "support/exact.h"
#include "support/gpu_fixture.h"
#include "support/oracle.h"
#include "support/shapes.h"

#include <cmath>
#include <limits>

namespace froxel::test {

namespace {

using glm::dvec3;

class HardFog : public SharedGpuTest {};

render::FrameInputs foggy(float density) {
    auto inputs = hardInputs();
    inputs.settings.fog.density = density;
    return inputs;
}

double sumOf(const Picture& picture) {
    double sum = 0;
    for (const float value : picture.radiance) {
        sum += static_cast<double>(value);
    }
    return sum;
}

double sumOf(const LinearImage& picture) {
    double sum = 0;
    for (const float value : picture.rgb) {
        sum += static_cast<double>(value);
    }
    return sum;
}

} // namespace

// Case 33. Lights behind the scene, before it, around the eye and behind it: clusters there are not
// empty, though no surface is.
TEST_F(HardFog, LightsInEmptySpace_AreInItsLists) {
    SceneMaker maker;
    maker.add(quad({-0.5F, -0.5F, -4}, {1, 0, 0}, {0, 1, 0}, 1, 0));
    maker.point({0.5, 0, -20}, 6, 50).point({1, 0.5, -1}, 1.5F).point({0, 0, 0.3}, 1);
    maker.point({-1, 0, 3}, 2.9F).point({-2, 1, -9}, 3, 10);
    maker.spot({2, 3, -12}, {-0.2, -1, 0.1}, 9, 15, 30);
    render::Renderer renderer(device(), maker.scene);
    auto inputs = foggy(0.05F);
    const auto pictures = expectExact(renderer, inputs);
    // The lamp 20 m away is seen in the air, round the quad.
    EXPECT_GT(at(pictures.naive, 32, 6, 0) + at(pictures.naive, 44, 17, 0), 1e-4F);
    inputs.settings.size = {192, 108};
    inputs.settings.fog.tile_px = 4;
    inputs.settings.fog.slice_count = 256;
    const auto reference = refer(renderer, maker.scene, inputs);
    const double drawn = sumOf(expectExact(renderer, inputs, Toon::kNo).naive);
    EXPECT_NEAR(drawn, sumOf(reference.picture), 0.05 * drawn);
}

// The eye in the middle of lights of all sizes, one of them at the eye itself.
TEST_F(HardFog, EyeInsideLights_IsFiniteAndRight) {
    auto maker = wallAhead(6);
    maker.point({0, 0, 0}, 4).point({0, 0, -0.001}, 0.01F).point({0.01, 0, -0.02}, 2);
    maker.point({0, 0, 1e-9}, 0);
    render::Renderer renderer(device(), maker.scene);
    auto inputs = foggy(0.2F);
    inputs.settings.fog.anisotropy = 0.9F;
    const auto pictures = expectExact(renderer, inputs);
    EXPECT_GT(litPixels(pictures.naive, 1e-3F), 1000U);
}

// From next to nothing to a wall of it, level, steep and everywhere the same.
TEST_F(HardFog, AnyDensityAndHeight_IsFiniteAndExact) {
    auto maker = insideOfABox(30);
    maker.point({0, 1, -3}, 5).point({2, -2, -9}, 0, 20);
    render::Renderer renderer(device(), maker.scene);
    render::ViewRenderer view(renderer);
    for (const float density : {1e-30F, 1e-6F, 1.0F, 100.0F}) {
        for (const float falloff : {0.0F, 1e-30F, 0.3F, 100.0F}) {
            for (const double base : {-1e7, -1.0, 0.0, 1e7}) {
                SCOPED_TRACE(std::to_string(density) + " " + std::to_string(falloff) + " " +
                             std::to_string(base));
                auto inputs = foggy(density);
                inputs.settings.size = {32, 18};
                inputs.settings.fog.height_falloff = falloff;
                inputs.settings.fog.base_height_m = base;
                (void)expectExact(view, inputs, Toon::kNo);
            }
        }
    }
}

// In fog that nothing is seen through: what is left is the light scattered near the eye.
TEST_F(HardFog, DenseFog_KeepsItsLight) {
    auto maker = wallAhead(6);
    maker.point({0.3, 0.2, -1}, 4, 100);
    render::Renderer renderer(device(), maker.scene);
    auto inputs = foggy(8);
    inputs.settings.size = {192, 108};
    inputs.settings.fog.tile_px = 4;
    inputs.settings.fog.slice_count = 128;
    const auto reference = refer(renderer, maker.scene, inputs);
    const double drawn = sumOf(expectExact(renderer, inputs, Toon::kNo).naive);
    EXPECT_GT(drawn, 0);
    EXPECT_NEAR(drawn, sumOf(reference.picture), 0.05 * drawn);
}

// As bright as floats go: finite, and black air keeps what is not scattered out of the picture.
TEST_F(HardFog, LightsOfAnyIntensity_AreFinite) {
    for (const float intensity : {1e12F, std::numeric_limits<float>::max()}) {
        SceneMaker maker;
        maker.add(quad({-5, -5, -2}, {10, 0, 0}, {0, 10, 0}, 1, 0));
        maker.point({0.03, 0.03, -1}, 0, intensity).point({0, 0, 0}, 3, intensity);
        maker.sun({0, -1, -1});
        maker.scene.lights.back().intensity = intensity;
        render::Renderer renderer(device(), maker.scene);
        for (const float density : {0.1F, 100.0F}) {
            auto inputs = foggy(density);
            inputs.settings.fog.anisotropy = -0.95F;
            (void)expectExact(renderer, inputs, Toon::kNo);
            inputs.settings.fog.albedo = {0, 1, 0};
            (void)expectExact(renderer, inputs, Toon::kNo);
        }
    }
}

// A radius of a tenth of a millimetre, of ten kilometres, and none.
TEST_F(HardFog, AnyRadius_IsExact) {
    auto maker = wallAhead(40);
    maker.point({0, 0, -3}, 1e-4F).point({1, 0, -10}, 1e4F).point({-1, 1, -20}, 0);
    maker.point({0, 0, -1e9}, 10);
    render::Renderer renderer(device(), maker.scene);
    (void)expectExact(renderer, foggy(0.01F));
    auto inputs = foggy(0.01F);
    inputs.settings.fog.height_falloff = 0.1F;
    (void)expectExact(renderer, inputs, Toon::kNo);
    inputs.settings.lights.scene_lights = false; // none at all
    (void)expectExact(renderer, inputs, Toon::kNo);
}

// A thousand kilometres from the origin, it looks as it does there.
TEST_F(HardFog, FarFromTheOrigin_LooksTheSame) {
    const auto sceneAt = [](const dvec3& away) {
        SceneMaker maker;
        maker.add(quad({-9, -9, -9}, {18, 0, 0}, {0, 18, 0}, 1, 0),
                  glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, away.x, away.y, away.z, 1));
        maker.point(away + dvec3(1, 0.5, -4), 3).point(away + dvec3(-1, -0.5, -2), 2);
        return std::move(maker.scene);
    };
    const dvec3 away(1'048'576, -524'288, 2'097'152);
    auto inputs = foggy(0.1F);
    inputs.settings.fog.height_falloff = 0.5F;
    inputs.settings.fog.base_height_m = -1;
    const auto near_scene = sceneAt(dvec3(0));
    render::Renderer near_renderer(device(), near_scene);
    const Picture first = expectExact(near_renderer, inputs, Toon::kNo).naive;
    const auto far_scene = sceneAt(away);
    render::Renderer far_renderer(device(), far_scene);
    inputs.settings.camera.eye_world += away;
    inputs.settings.fog.base_height_m += away.y;
    EXPECT_EQ(differingFloats(first, expectExact(far_renderer, inputs, Toon::kNo).naive), 0U);
}

// Parallel rays, of a picture from a millimetre to kilometres wide, and lenses far off their
// centre.
TEST_F(HardFog, AnyProjection_IsExact) {
    auto maker = insideOfABox(20);
    maker.point({0, 0, -5}, 3).point({4, 2, -9}, 6).spot({0, 5, -8}, {0, -1, 0}, 12, 20, 40);
    render::Renderer renderer(device(), maker.scene);
    render::ViewRenderer view(renderer);
    for (const double half_height_m : {0.0005, 3.0, 5000.0}) {
        auto inputs = foggy(0.1F);
        inputs.settings.camera.projection = settings::Projection::kOrthographic;
        inputs.settings.camera.half_height_m = half_height_m;
        (void)expectExact(view, inputs, Toon::kNo);
    }
    for (const glm::dvec2& shift : {glm::dvec2(1, 0), glm::dvec2(-40, 64)}) {
        auto inputs = foggy(0.1F);
        inputs.settings.camera.lens_shift = shift;
        (void)expectExact(view, inputs, Toon::kNo);
    }
    for (const double yfov_deg : {1.0, 170.0}) {
        auto inputs = foggy(0.1F);
        inputs.settings.camera.yfov_rad = glm::radians(yfov_deg);
        (void)expectExact(view, inputs, Toon::kNo);
    }
}

// More lights than a software rasteriser's loops have iterations, in each froxel.
TEST_F(HardFog, LongLists_AreWhole) {
    auto maker = wallAhead(4);
    render::Renderer renderer(device(), maker.scene);
    auto inputs = foggy(0.1F);
    inputs.settings.size = {16, 16};
    inputs.settings.lights.count = 70'000;
    inputs.settings.lights.intensity = 1e-3F;
    inputs.settings.lights.radius_m = 30;
    inputs.settings.lights.box = BoundsD3{{-4, -3, -3}, {4, 3, -1}};
    inputs.settings.grid.size = {1, 1, 2}; // every list has nearly all of them
    inputs.settings.fog.tile_px = 64;
    inputs.settings.fog.slice_count = 8;
    const auto all = expectExact(renderer, inputs, Toon::kNo).naive;
    inputs.settings.lights.count = 35'000; // half of them: about half the light
    const auto half = expectExact(renderer, inputs, Toon::kNo).naive;
    EXPECT_NEAR(sumOf(all) / sumOf(half), 2, 0.1);
}

} // namespace froxel::test

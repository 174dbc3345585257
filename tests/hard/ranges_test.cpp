// Very dim, very bright, exactly at the rim, seen through glass.
#include "support/exact.h"
#include "support/gpu_fixture.h"
#include "support/oracle.h"
#include "support/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace froxel::test {

namespace {

using glm::dvec3;

class HardRanges : public SharedGpuTest {};

// The least of red, green and blue of a pixel's 8-bit colour.
int leastChannel(const Picture& picture, uint32_t x, uint32_t y) {
    const size_t i = 4 * (size_t{y} * picture.width_px + x);
    int least = 255;
    for (size_t c = 0; c < 3; ++c) {
        least = std::min(least, std::to_integer<int>(picture.rgba8[i + c]));
    }
    return least;
}

scene::Material glass(const glm::vec4& color) {
    scene::Material material = chalk();
    material.base_color = color;
    material.alpha_mode = scene::AlphaMode::kBlend;
    material.double_sided = true;
    return material;
}

} // namespace

// Case 13. A wall as far as the light reaches, by a millionth more or less.
TEST_F(HardRanges, RimOfALight_EndsAtExactlyNothing) {
    for (const double share : {1 - 1e-6, 1 + 1e-6}) {
        SCOPED_TRACE(share);
        auto maker = wallAhead(4);
        const float range = 1.5F;
        // The foot of the perpendicular is a pixel's own point.
        const double px = 2 * std::tan(glm::radians(30.0)) / 36 * 4;
        maker.point({0.5 * px, 0.5 * px, -4 + static_cast<double>(range) * share}, range, 1e12F);
        render::Renderer renderer(device(), maker.scene);
        const auto pictures = expectExact(renderer, hardInputs(), Toon::kNo);
        // 4e-6 squared, times 1e12 cd: bright, were it not for the rim.
        EXPECT_EQ(litPixels(pictures.naive), share < 1 ? 1U : 0U);
    }
}

// Case 42. What accumulates in half precision or R11G11B10 stops to grow, or changes its hue.
TEST_F(HardRanges, ThousandsOfDimLights_AddUp) {
    auto maker = wallAhead(4);
    render::Renderer renderer(device(), maker.scene);
    auto inputs = hardInputs();
    inputs.settings.size = {32, 18};
    inputs.settings.lights.count = 5000;
    inputs.settings.lights.intensity = 1e-3F;
    inputs.settings.lights.radius_m = 30;
    inputs.settings.lights.box = BoundsD3{{-4, -3, -3}, {4, 3, -1}};
    const auto pictures = expectExact(renderer, inputs, Toon::kNo);
    const auto worst =
        worstOf(pictures.naive, refer(renderer, maker.scene, inputs), within(5000 * 0x1p-24, 0));
    EXPECT_LE(worst.ratio, 1) << worst;
    EXPECT_GT(litPixels(pictures.naive, 0.05F), 32U * 18U / 2U);
}

// Case 43. Beyond what halves hold, up to what a float does: finite, and white on the screen, on
// chalk and on metal.
TEST_F(HardRanges, LightsOfAnyIntensity_AreFiniteAndWhite) {
    for (const float metallic : {0.0F, 1.0F}) {
        for (const float intensity : {1e6F, 1e12F, std::numeric_limits<float>::max()}) {
            SCOPED_TRACE(intensity);
            scene::Material material = chalk();
            material.metallic = metallic;
            material.roughness = metallic > 0 ? 0 : 1; // a mirror, as sharp as it may be
            SceneMaker maker(material);
            maker.add(quad({-5, -5, -2}, {10, 0, 0}, {0, 10, 0}, 1, 0));
            maker.point({0.03, 0.03, -1.995}, 0, intensity);
            maker.point({0, 0, 0}, 0, intensity);
            render::Renderer renderer(device(), maker.scene);
            auto inputs = hardInputs();
            inputs.settings.shading = settings::ShadingModel::kPbr;
            const auto pictures = expectExact(renderer, inputs, Toon::kNo);
            EXPECT_EQ(leastChannel(pictures.naive, 32, 17), 255);
            EXPECT_EQ(leastChannel(pictures.deferred, 32, 17), 255);
        }
    }
}

// Case 43, too. The G-buffer's emission has nine bits and a shared exponent: half a step of 2^-9.
TEST_F(HardRanges, BrightEmission_KeepsItsValue) {
    for (const float strength : {1e-3F, 1.0F, 6e4F, 1e6F, 1e12F}) {
        SCOPED_TRACE(strength);
        scene::Material lamp = chalk();
        lamp.emissive = glm::vec3(1.0F, 0.5F, 0.75F) * strength;
        SceneMaker maker(lamp);
        maker.add(quad({-5, -5, -2}, {10, 0, 0}, {0, 10, 0}, 1, 0));
        maker.point({0, 0, -1}, 3);
        render::Renderer renderer(device(), maker.scene);
        const auto inputs = hardInputs();
        const auto pictures = expectExact(renderer, inputs, Toon::kNo);
        const auto reference = refer(renderer, maker.scene, inputs);
        const auto forward = worstOf(pictures.naive, reference, within(1e-5, 0));
        EXPECT_LE(forward.ratio, 1) << forward;
        const double step = static_cast<double>(strength) * 0x1p-9;
        const auto deferred = worstOf(pictures.deferred, reference, within(1e-4, step));
        EXPECT_LE(deferred.ratio, 1) << deferred;
    }
}

// Case 31. Clusters before the nearest solid surface are not empty: glass is there.
TEST_F(HardRanges, GlassBeforeAFarWall_IsLitByItsOwnClusters) {
    auto maker = wallAhead(50);
    const uint32_t pane = maker.add(glass({0.6F, 0.8F, 0.9F, 0.4F}));
    const uint32_t other = maker.add(glass({0.9F, 0.4F, 0.3F, 0.7F}));
    maker.add(quad({-0.4F, -0.3F, -1}, {0.8F, 0, 0}, {0, 0.6F, 0}, 1, pane));
    maker.add(quad({-3, -1, -5}, {4, 0, 0}, {0, 3, 0}, 1, other));
    maker.point({0, 0, -0.75}, 1).point({0.3, 0.2, -4}, 3).point({-1, 0, -30}, 25, 100);
    render::Renderer renderer(device(), maker.scene);
    const auto inputs = hardInputs();
    const auto pictures = expectExact(renderer, inputs);
    EXPECT_GT(at(pictures.naive, 32, 18, 0), at(pictures.naive, 32, 1, 0));
    const auto reference = refer(renderer, maker.scene, inputs);
    const auto worst = worstOf(pictures.naive, reference, within(1e-4, 1e-5));
    EXPECT_LE(worst.ratio, 1) << worst;
}

// Case 32. Five panes in one plane: nothing says which is in front, so it must be the same always.
TEST_F(HardRanges, PanesInOnePlane_AreDrawnInOneOrder) {
    auto maker = wallAhead(4);
    for (int i = 0; i < 5; ++i) {
        const auto part = static_cast<float>(i) / 5;
        const uint32_t pane = maker.add(glass({part, 1 - part, 0.5F, 0.5F}));
        maker.add(quad({-1, -1, -2}, {2, 0, 0}, {0, 2, 0}, 1, pane));
    }
    maker.point({0, 0, -1}, 0, 10);
    const auto inputs = hardInputs();
    render::Renderer renderer(device(), maker.scene);
    const Picture first = expectExact(renderer, inputs).naive;
    render::Renderer again(device(), maker.scene);
    EXPECT_EQ(differingFloats(first, expectExact(again, inputs, Toon::kNo).naive), 0U);
}

// Two solid surfaces in one plane: the last drawn stays, with and without lists or a prepass.
TEST_F(HardRanges, SurfacesInOnePlane_ShowTheSameOne) {
    auto maker = wallAhead(2);
    scene::Material red = chalk();
    red.base_color = {1, 0.1F, 0.1F, 1};
    const uint32_t paint = maker.add(red);
    maker.add(quad({-0.5F, -0.5F, -2}, {1, 0, 0}, {0, 1, 0}, 3, paint));
    maker.add(quad({-0.7F, -0.2F, -2}, {1, 0, 0}, {0, 1, 0}, 2, 0));
    maker.point({0, 0, -1}, 0, 10);
    render::Renderer renderer(device(), maker.scene);
    const Picture first = expectExact(renderer, hardInputs()).naive;
    render::Renderer again(device(), maker.scene);
    EXPECT_EQ(differingFloats(first, expectExact(again, hardInputs(), Toon::kNo).naive), 0U);
}

} // namespace froxel::test

// Spots of every width, direction and reach.
#include "light/light_rig.h"
#include "reference/shade.h"
#include "support/exact.h"
#include "support/gpu_fixture.h"
#include "support/oracle.h"
#include "support/shapes.h"

#include <cmath>

namespace froxel::test {

namespace {

using glm::dvec3;

class HardSpots : public SharedGpuTest {};

constexpr double kWall_m = 3;

// The point of the wall in the middle of a pixel of the 64 x 36 picture.
dvec3 wallPoint(double x, double y) {
    const double half = std::tan(glm::radians(30.0)) * kWall_m;
    return {((x + 0.5) / 32 - 1) * half * 64 / 36, (1 - (y + 0.5) / 18) * half, -kWall_m};
}

// The picture with every spot as a point light: what falls on a surface but for the cones.
scene::Scene withoutCones(scene::Scene scene) {
    for (auto& light : scene.lights) {
        light.type = scene::LightType::kPoint;
    }
    return scene;
}

// A cone's share is clamp(cos * scale + offset)^2. The cosine is a product of two rounded unit
// vectors, off by at most 8 * 2^-24 with what the position adds; scale is at most 1000, and the
// share's slope at most 2 * scale.
constexpr double kShareError = 2 * 1000 * 8 * 0x1p-24;

void expectLikeReference(render::Renderer& renderer,
                         const scene::Scene& scene,
                         const render::FrameInputs& inputs,
                         const Picture& picture) {
    const Reference reference = refer(renderer, scene, inputs);
    expectNoneMissing(scene, inputs, reference.visibility);
    const auto points =
        reference::shade(withoutCones(scene), inputs.settings, 0, reference.visibility);
    ASSERT_TRUE(points);
    double worst = 0;
    for (size_t i = 0; i < picture.radiance.size(); ++i) {
        const auto device = static_cast<double>(picture.radiance[i]);
        const auto wanted = static_cast<double>(reference.picture.rgb[i]);
        const double allowed = kShareError * static_cast<double>(points->rgb[i]) + 1e-7;
        worst = std::max(worst, std::abs(device - wanted) / allowed);
    }
    EXPECT_LE(worst, 1);
}

} // namespace

// Placed lights come after the scene's, each with a radius of its own: points and spots, near and
// far, one reaching past all. They shine as the scene's own would, to the bit.
TEST_F(HardSpots, Placed_AreTheScenesOwn) {
    scene::Scene scene = wallAhead(static_cast<float>(kWall_m)).scene;
    std::vector<settings::PlacedLight> placed;
    for (uint32_t i = 0; i < 24; ++i) {
        settings::PlacedLight light;
        light.id = 5 * i + 1;
        light.kind = i % 3 == 0 ? settings::LightKind::kSpot : settings::LightKind::kPoint;
        light.position_world = wallPoint(2.5 * i, i) + dvec3(0, 0, 0.1 * (i + 1));
        light.direction_world = {0, 0.1 * i, -1};
        light.color = {1, 0.04F * static_cast<float>(i), 0.5F};
        light.radius_m = i == 7 ? 10'000 : 0.2F * static_cast<float>(i + 1);
        placed.push_back(light);
        scene.lights.push_back(light::asPunctual(light));
    }
    auto inputs = hardInputs();
    render::Renderer with_scene_lights(device(), scene);
    const auto wanted = expectExact(with_scene_lights, inputs);
    scene.lights.clear();
    inputs.settings.lights.placed = settings::PlacedLights(placed);
    render::Renderer renderer(device(), scene);
    const auto pictures = expectExact(renderer, inputs);
    EXPECT_GT(litPixels(pictures.naive), 500U);
    EXPECT_EQ(differingFloats(pictures.naive, wanted.naive), 0U);
    EXPECT_EQ(differingFloats(pictures.forward_plus, wanted.forward_plus), 0U);
    EXPECT_EQ(differingFloats(pictures.deferred, wanted.deferred), 0U);
}

// In the places of seeded lights and of the scene's.
TEST_F(HardSpots, StandingForOthers_AreAsDoublePrecisionHasThem) {
    auto maker = wallAhead(static_cast<float>(kWall_m));
    maker.point({0.5, 0.4, -2.5}, 2).point({-0.5, 0.4, -2.5}, 2);
    auto inputs = hardInputs();
    inputs.settings.lights.count = 9;
    inputs.settings.lights.box = BoundsD3{{-2, -1, -3.4}, {2, 1, -2}};
    render::Renderer renderer(device(), maker.scene);
    const auto before = expectExact(renderer, inputs);
    using Of = settings::LightRef::Of;
    std::vector<settings::PlacedLight> placed;
    for (const auto& replaced : {settings::LightRef{Of::kSeed, 6}, settings::LightRef{Of::kSeed, 2},
                                 settings::LightRef{Of::kScene, 0}}) {
        settings::PlacedLight light;
        light.id = static_cast<uint32_t>(placed.size()) + 1;
        light.kind = placed.size() == 1 ? settings::LightKind::kPoint : settings::LightKind::kSpot;
        light.position_world = {static_cast<double>(placed.size()) - 1, 0.3, -2.2};
        light.direction_world = {0.2, 0.1, -1};
        light.radius_m = 2.5;
        light.replaces = replaced;
        placed.push_back(light);
    }
    inputs.settings.lights.placed = settings::PlacedLights(placed);
    const auto pictures = expectExact(renderer, inputs);
    EXPECT_GT(differingFloats(pictures.naive, before.naive), 500U);
    expectLikeReference(renderer, maker.scene, inputs, pictures.naive);
}

// Case 26. Each is aimed at a pixel's own point, since the narrowest light less than a pixel.
TEST_F(HardSpots, AnyHalfAngle_IsAsDoublePrecisionHasIt) {
    for (const double inner_share : {0.0, 0.9}) {
        SCOPED_TRACE(inner_share);
        auto maker = wallAhead(static_cast<float>(kWall_m));
        double x = 2;
        for (const double outer :
             {0.01, 0.5, 1.0, 5.0, 44.9, 45.0, 45.1, 79.9, 80.0, 80.1, 89.9, 90.0, 120.0, 180.0}) {
            const dvec3 target = wallPoint(x, 18);
            const dvec3 apex = target + dvec3(0.25, 0.5, 1.5);
            maker.spot(apex, target - apex, 4, outer * inner_share, outer);
            x += 4;
        }
        render::Renderer renderer(device(), maker.scene);
        const auto inputs = hardInputs();
        const auto pictures = expectExact(renderer, inputs);
        expectLikeReference(renderer, maker.scene, inputs, pictures.naive);
    }
}

// The narrowest by themselves: they do light their pixel.
TEST_F(HardSpots, NarrowCone_LightsThePixelThatItIsAimedAt) {
    for (const double outer : {0.5, 2.0}) {
        SCOPED_TRACE(outer);
        auto maker = wallAhead(static_cast<float>(kWall_m));
        const dvec3 target = wallPoint(40, 9);
        const dvec3 apex = target + dvec3(0.1, 0.2, 1);
        maker.spot(apex, target - apex, 4, 0, outer);
        render::Renderer renderer(device(), maker.scene);
        const auto pictures = expectExact(renderer, hardInputs(), Toon::kNo);
        EXPECT_GT(at(pictures.naive, 40, 9, 0), 0.0F);
        EXPECT_LE(litPixels(pictures.naive), 9U);
    }
}

// Case 27. Nothing divides by the difference of the cosines, which is 0; it is a step, 1e-3 of a
// cosine wide (KHR_lights_punctual's own floor).
TEST_F(HardSpots, InnerEqualsOuter_IsAStep) {
    auto maker = wallAhead(static_cast<float>(kWall_m));
    const dvec3 apex(0, 0, -1);
    maker.spot(apex, {0, 0, -1}, 0, 30, 30);
    render::Renderer renderer(device(), maker.scene);
    const auto points = withoutCones(maker.scene);
    render::Renderer point_renderer(device(), points);
    const auto inputs = hardInputs();
    const Picture spot = expectExact(renderer, inputs).naive;
    const Picture point = expectExact(point_renderer, inputs, Toon::kNo).naive;
    const double outer = std::cos(glm::radians(30.0));
    size_t inside = 0;
    size_t outside = 0;
    for (uint32_t y = 0; y < 36; ++y) {
        for (uint32_t x = 0; x < 64; ++x) {
            const double cosine = -glm::normalize(wallPoint(x, y) - apex).z;
            if (cosine > outer + 1e-3 + 1e-6) {
                EXPECT_EQ(at(spot, x, y, 0), at(point, x, y, 0));
                ++inside;
            } else if (cosine < outer - 1e-6) {
                EXPECT_EQ(at(spot, x, y, 0), 0.0F);
                ++outside;
            }
        }
    }
    EXPECT_GT(inside, 100U);
    EXPECT_GT(outside, 100U);
}

// Case 28. Along every axis and a hair off them, from the eye, from before and from behind it.
TEST_F(HardSpots, AnyDirectionAndApex_ListsLackNothing) {
    auto maker = insideOfABox(4);
    for (const double hair : {0.0, 1e-8, -1e-8}) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const double way : {1.0, -1.0}) {
                dvec3 direction(hair);
                direction[axis] = way;
                maker.spot({0, 0, 0}, direction, 10, 10, 40);            // the eye is the apex
                maker.spot(dvec3(0, 0, 2) + hair, direction, 10, 5, 60); // behind it
                maker.spot(-3.0 * direction, direction, 10, 0, 20);      // the eye is in the cone
            }
        }
    }
    render::Renderer renderer(device(), maker.scene);
    const auto inputs = hardInputs();
    const auto pictures = expectExact(renderer, inputs);
    EXPECT_GT(litPixels(pictures.naive), 64U * 36U / 2U);
    expectNoneMissing(maker.scene, inputs, refer(renderer, maker.scene, inputs).visibility);
}

// Case 29. Far away: directions and falloffs in half precision would be off by whole percents.
TEST_F(HardSpots, HundredsOfMetresAway_IsAsDoublePrecisionHasIt) {
    auto maker = wallAhead(250);
    for (int i = -3; i <= 3; ++i) {
        maker.spot({i * 12.0, 3, 0}, {i * 0.02, 0.01, -1}, 300, 2, 8);
        maker.scene.lights.back().intensity = 1e4F;
    }
    render::Renderer renderer(device(), maker.scene);
    const auto inputs = hardInputs();
    const auto pictures = expectExact(renderer, inputs);
    const auto reference = refer(renderer, maker.scene, inputs);
    expectNoneMissing(maker.scene, inputs, reference.visibility);
    EXPECT_GT(litPixels(pictures.naive, 1e-3F), 100U);
    const double brightest = static_cast<double>(largest(pictures.naive));
    const auto worst = worstOf(pictures.naive, reference, within(1e-3, 1e-3 * brightest));
    EXPECT_LE(worst.ratio, 1) << worst;
}

} // namespace froxel::test

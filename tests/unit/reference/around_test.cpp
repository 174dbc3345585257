// Light from around in the reference, against closed forms and quadrature.
#include "environment/albedo.h"
#include "reference/around.h"
#include "reference/shade.h"
#include "unit/environment/axes.h"

#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace froxel::reference {
namespace {

const Model kPbr{};
const Model kLambert{settings::ShadingModel::kLambert, nullptr};

environment::Surroundings surroundingsOf(const LinearImage& panorama) {
    return {
        environment::diffuseOf(panorama),
        environment::prefilter(environment::Pyramid(panorama), {.finest_px = 32, .samples = 32})};
}

Around placed(const environment::Surroundings& seen, double rotation_rad, double strength) {
    return {&seen, rotation_rad, strength, environment::placed(seen.matt, rotation_rad, strength)};
}

Surface surfaceOf(double n_dot_v, double roughness, double metallic) {
    Surface s;
    s.to_eye = {std::sqrt(1 - n_dot_v * n_dot_v), n_dot_v, 0};
    s.roughness = roughness;
    s.metallic = metallic;
    return s;
}

TEST(ReferenceAround, WhiteFurnace_IsWhite) {
    const glm::dvec3 sky(0.25, 1, 4);
    const auto seen =
        surroundingsOf(environment::panoramaOf(8, [&](const glm::dvec3&) { return sky; }));
    const Around around = placed(seen, 1, 3);
    for (const double roughness : {0.0, 0.3, 1.0}) {
        for (const double metallic : {0.0, 0.4, 1.0}) {
            for (const double n_dot_v : {0.01, 0.5, 1.0}) {
                const Surface s = surfaceOf(n_dot_v, roughness, metallic);
                for (const Model& model : {kPbr, kLambert}) {
                    const glm::dvec3 out = fromAround(s, model, around);
                    EXPECT_NEAR(out.x, 3 * sky.x, 1e-5);
                    EXPECT_NEAR(out.z, 3 * sky.z, 1e-5);
                }
            }
        }
    }
}

// The table is off by up to 0.003.
TEST(ReferenceAround, ColouredMetal_ReflectsWhatItsLobeDoes) {
    const auto seen =
        surroundingsOf(environment::panoramaOf(8, [](const glm::dvec3&) { return glm::dvec3(1); }));
    const Around around = placed(seen, 0, 1);
    for (const double roughness : {0.2, 0.6, 1.0}) {
        for (const double n_dot_v : {0.1, 0.5, 1.0}) {
            Surface s = surfaceOf(n_dot_v, roughness, 1);
            s.base_color = {0.2, 0.5, 0.9};
            const auto lobe = environment::albedo(n_dot_v, roughness);
            const glm::dvec3 out = fromAround(s, kPbr, around);
            EXPECT_NEAR(out.x, environment::reflectedShare(0.2, lobe), 0.01);
            EXPECT_NEAR(out.z, environment::reflectedShare(0.9, lobe), 0.01);
        }
    }
}

// A smooth metal that faces +X, where a quarter turn has brought what was ahead, at +Z.
TEST(ReferenceAround, Turned_ShowsWhatWasAheadToTheRight) {
    const auto seen = surroundingsOf(environment::panoramaOf(64, [](const glm::dvec3& direction) {
        return glm::dvec3(direction.x > 0.7, direction.y > 0.7, direction.z > 0.7);
    }));
    Surface s = surfaceOf(1, 0, 1);
    s.normal = s.to_eye = {1, 0, 0};
    const glm::dvec3 before = fromAround(s, kPbr, placed(seen, 0, 1));
    EXPECT_GT(before.x, 0.95);
    EXPECT_LT(before.z, 0.05);
    const glm::dvec3 after = fromAround(s, kPbr, placed(seen, glm::radians(90.0), 1));
    EXPECT_LT(after.x, 0.05);
    EXPECT_GT(after.z, 0.95);
    EXPECT_GT(radianceFrom(placed(seen, 0, 2), {0, 5, 0}, 0).y, 1.9);
}

TEST(ReferenceAround, PanoramaThatTheSceneLacks_IsRefused) {
    settings::ViewSettings view;
    view.size = {16, 16};
    view.environment.light = settings::EnvironmentLight::kFile;
    Visibility nothing{16, 16, {}, {}};
    nothing.pixels.resize(256, {VisibleTriangle::kNothing, 0, 0});
    const auto refused = shade({}, view, 0, nothing);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
}

} // namespace
} // namespace froxel::reference

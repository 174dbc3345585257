// The reference's medium against closed forms and against sums of many small steps.
#include "reference/fog.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace froxel::reference {
namespace {

constexpr double kPi = std::numbers::pi;
const Open kNothingBetween = [](const glm::dvec3&, const glm::dvec3&) { return true; };

settings::Camera eyeAt(double height_m) {
    settings::Camera camera;
    camera.eye_world = {0, height_m, 0};
    return camera;
}

double squared(double x) {
    return x * x;
}

// By the definition, in steps of equal length.
double steppedDepth(const Medium& medium, const glm::dvec3& from, const glm::dvec3& to, int steps) {
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        sum += medium.densityAt(glm::mix(from, to, (i + 0.5) / steps));
    }
    return sum * glm::distance(from, to) / steps;
}

TEST(ReferenceFog, Phase_OverAllDirections_IsOne) {
    for (const double g : {-0.9, 0.0, 0.3, 0.95}) {
        double sum = 0;
        constexpr int kRings = 200'000;
        for (int i = 0; i < kRings; ++i) {
            sum += phase(g, -1 + 2 * (i + 0.5) / kRings) * 2 * kPi * 2 / kRings;
        }
        EXPECT_NEAR(sum, 1, 1e-5) << g;
    }
    EXPECT_GT(phase(0.5, 1), phase(0.5, -1)); // onwards
}

TEST(ReferenceFog, OpticalDepth_IsTheDensitysIntegral) {
    const Lights lights;
    for (const float falloff : {0.0F, 0.01F, 0.5F, 8.0F}) {
        for (const double eye_m : {-3.0, 0.0, 2.0}) {
            const settings::Fog fog{
                .density = 0.25F, .height_falloff = falloff, .base_height_m = 0.5};
            const Medium medium(fog, eyeAt(eye_m), lights, kNothingBetween);
            for (const glm::dvec3& to : {glm::dvec3(3, 5, -4), glm::dvec3(1, -6, 2),
                                         glm::dvec3(4, 0, 1), glm::dvec3(0, 9, 0)}) {
                EXPECT_NEAR(medium.opticalDepth({0, -1, 0}, to),
                            steppedDepth(medium, {0, -1, 0}, to, 400'000), 1e-5);
            }
        }
    }
}

TEST(ReferenceFog, Light_IsTheSumOfManySteps) {
    const Lights none;
    const settings::Fog fog{.density = 0.2F, .height_falloff = 0.3F, .anisotropy = 0.6F};
    const Medium medium(fog, eyeAt(1), none, kNothingBetween);
    PointLight light{.position = {0.4, 0.3, -5}, .radius2 = 9, .color = {2, 1, 0}};
    PointLight spot = light;
    spot.direction = glm::normalize(glm::dvec3(-0.2, -0.3, -1));
    spot.cone_scale = 4;
    spot.cone_offset = -3;
    const Ray ray{{0.1, 0, 0}, {0.05, 0.02, -1}};
    const glm::dvec3 away = glm::normalize(ray.direction);
    for (const auto& lamp : {light, spot}) {
        constexpr int kSteps = 400'000;
        const double length_m = 6;
        double sum = 0;
        for (int i = 0; i < kSteps; ++i) {
            const glm::dvec3 point = ray.origin + away * (length_m * (i + 0.5) / kSteps);
            const glm::dvec3 to_light = lamp.position - point;
            const double d2 = glm::dot(to_light, to_light);
            const double d = std::sqrt(d2);
            const double window = squared(std::max(0.0, 1 - squared(d2 / lamp.radius2)));
            const double towards = -glm::dot(lamp.direction, to_light) / d;
            const double cone =
                squared(std::clamp(towards * lamp.cone_scale + lamp.cone_offset, 0.0, 1.0));
            sum += medium.densityAt(point) *
                   std::exp(-medium.opticalDepth(ray.origin, point) -
                            medium.opticalDepth(point, lamp.position)) *
                   phase(static_cast<double>(0.6F), glm::dot(to_light, away) / d) * window * cone /
                   std::max(d2, 1e-4) * length_m / kSteps;
        }
        EXPECT_GT(sum, 1e-3);
        // A cone's edge is a kink, which the rule does not know of.
        const double allowed = lamp.cone_scale > 0 ? 1e-3 : 1e-5;
        EXPECT_NEAR(medium.scattered(lamp, ray, length_m).x, 2 * sum, allowed * sum);
        EXPECT_EQ(medium.scattered(lamp, ray, length_m).z, 0);
    }
}

TEST(ReferenceFog, LightAtTheRay_IsFiniteAndLarge) {
    const Lights none;
    const settings::Fog fog{.density = 1e-4F};
    const Medium medium(fog, eyeAt(0), none, kNothingBetween);
    const PointLight light{.position = {0, 0, -5}, .color = {1, 1, 1}};
    const double sum = medium.scattered(light, {{}, {0, 0, -1}}, 1e9).x;
    // 1 / (4 pi) * (2 * 1 cm / (1 cm)^2 + the two tails of 1 / d^2 from 1 cm on)
    EXPECT_NEAR(sum, 1e-4 / (4 * kPi) * (200 + 100 + 100 - 1 / 5.0), 0.02 * sum);
}

// White, without light of its own, in light of one radiance from all around: nothing is seen of it.
TEST(ReferenceFog, Furnace_OfAlbedoOne_ShowsNothing) {
    Lights lights;
    lights.sky = lights.ground = glm::dvec3(0.25);
    for (const float falloff : {0.0F, 0.4F}) {
        const settings::Fog fog{.density = 0.3F, .height_falloff = falloff};
        const Medium medium(fog, eyeAt(1), lights, kNothingBetween);
        for (const double distance : {0.1, 3.0, 1e3, std::numeric_limits<double>::infinity()}) {
            const glm::dvec3 seen =
                medium.seenThrough(glm::dvec3(0.25), {{}, {0.1, 0.2, -1}}, distance);
            EXPECT_NEAR(seen.x, 0.25, 1e-15);
        }
    }
}

TEST(ReferenceFog, NoDensity_IsTransparent) {
    const Lights lights;
    const settings::Fog fog;
    const Medium medium(fog, eyeAt(1), lights, kNothingBetween);
    EXPECT_EQ(medium.seenThrough({1, 2, 3}, {{}, {0, 0, -1}}, 1e300), glm::dvec3(1, 2, 3));
}

} // namespace
} // namespace froxel::reference

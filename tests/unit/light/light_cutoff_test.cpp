#include "light/light_cutoff.h"
#include "light/light_rig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace froxel::light {
namespace {

double windowed(double strongest, double radius_m, double distance_m) {
    const double x = distance_m * distance_m / (radius_m * radius_m);
    const double window = std::pow(std::max(0.0, 1 - x * x), 2);
    return strongest * window / (distance_m * distance_m);
}

TEST(LightCutoff, CutRadius_IsWhereTheIrradianceFallsToIt) {
    for (const double radius : {0.05, 0.5, 2.0, 50.0}) {
        for (const float strongest : {0.1F, 1.0F, 300.0F}) {
            for (const double cutoff : {1e-6, 1e-3, 0.02, 1.0}) {
                const double cut =
                    cutRadius({0, strongest, 0.5F * strongest}, radius, cutoff, kNearest_m);
                ASSERT_LE(cut, radius);
                if (cut > 0) {
                    EXPECT_NEAR(windowed(static_cast<double>(strongest), radius, cut) / cutoff, 1,
                                1e-6)
                        << radius << " m, " << strongest << ", cut at " << cutoff;
                } else {
                    EXPECT_LE(windowed(static_cast<double>(strongest), radius, 0.01), cutoff);
                }
            }
        }
    }
}

TEST(LightCutoff, UnlimitedLight_EndsByTheInverseSquare) {
    const double cut =
        cutRadius({4, 1, 1}, std::numeric_limits<double>::infinity(), 0.01, kNearest_m);
    EXPECT_NEAR(cut, 20, 1e-9);
}

// More than one thread cuts.
TEST(LightCutoff, VeryMany_AreEachCut) {
    FrameLights lights;
    for (uint32_t i = 0; i < 50'000; ++i) {
        const float radius_m = 0.5F + static_cast<float>(i % 17);
        lights.lights.push_back({.position_view = {},
                                 .inv_radius2 = 1 / (radius_m * radius_m),
                                 .color = glm::vec3(static_cast<float>(i % 5)),
                                 .spot = io::kNoSpot});
        lights.radii_m.push_back(radius_m);
    }
    const FrameLights whole = lights;
    cutLights(lights, 0.01, false);
    for (size_t i = 0; i < lights.lights.size(); ++i) {
        const double cut = cutRadius(whole.lights[i].color, static_cast<double>(whole.radii_m[i]),
                                     0.01, kNearest_m);
        ASSERT_EQ(lights.radii_m[i], static_cast<float>(cut)) << i;
    }
}

// Weak lights of a small scene: they are cut off where nothing is nearer.
TEST(LightCutoff, LightTooWeakForAnyPlace_DependsOnTheNearestDistance) {
    EXPECT_EQ(cutRadius({1e-6, 0, 0}, 1, 0.1, kNearest_m), 0);
    EXPECT_NEAR(cutRadius({1e-6, 0, 0}, 1, 0.1, 1e-4), std::sqrt(1e-5), 1e-9);
}

TEST(NearestDistance, IsAShareOfSmallScenesAndACentimetreOfOthers) {
    const auto of = [](double side_m) {
        BoundsD3 bounds;
        bounds.add(glm::dvec3(0));
        bounds.add(glm::dvec3(side_m, 0, 0));
        return nearestDistance(bounds);
    };
    EXPECT_DOUBLE_EQ(of(0.02), 5e-5);
    EXPECT_NEAR(of(4), kNearest_m, 1e-15);
    EXPECT_EQ(of(4.1), kNearest_m);
    EXPECT_EQ(of(1e6), kNearest_m);
    EXPECT_GT(of(0), 0);
    EXPECT_EQ(nearestDistance({}), kNearest_m);
}

TEST(LightCutoff, BlackLight_ReachesNothing) {
    EXPECT_EQ(cutRadius({0, 0, 0}, 2, 0.01, kNearest_m), 0);
}

// What a light adds to points spread evenly in space, by Simpson's rule, is what it was.
TEST(LightCutoff, Compensated_KeepsWhatALightAddsInTheMean) {
    const auto total = [](double strongest, double radius_m) {
        constexpr int kSteps = 2000;
        double sum = 0;
        for (int i = 0; i <= kSteps; ++i) {
            const double d = radius_m * i / kSteps;
            const double weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
            sum += weight * (i == 0 ? strongest : windowed(strongest, radius_m, d) * d * d);
        }
        return sum * radius_m / kSteps / 3;
    };
    FrameLights lights;
    for (const float radius : {0.5F, 2.0F, 30.0F}) {
        io::Light light{};
        light.color = {1, 0.5F, 0};
        lights.lights.push_back(light);
        lights.radii_m.push_back(radius);
    }
    FrameLights dimmed = lights;
    cutLights(dimmed, 0.05, false);
    FrameLights kept = lights;
    cutLights(kept, 0.05, true);
    for (size_t i = 0; i < lights.lights.size(); ++i) {
        const auto of = [&](const FrameLights& all) {
            return total(static_cast<double>(all.lights[i].color.x),
                         static_cast<double>(all.radii_m[i]));
        };
        EXPECT_NEAR(of(kept) / of(lights), 1, 1e-6) << lights.radii_m[i];
        EXPECT_LT(of(dimmed), of(lights));
        EXPECT_EQ(kept.radii_m[i], dimmed.radii_m[i]);
        EXPECT_EQ(kept.lights[i].color.y, 0.5F * kept.lights[i].color.x);
    }
    lights.radii_m = std::vector<float>(3, std::numeric_limits<float>::infinity());
    cutLights(lights, 0.05, true);
    EXPECT_EQ(lights.lights[0].color.x, 1); // it would lose without end
}

TEST(LightCutoff, LightRig_CutsWhereItIsAskedTo) {
    scene::Scene scene;
    scene.bounds_world = {{-1, -1, -1}, {1, 1, 1}};
    settings::Lights settings;
    settings.count = 50;
    FrameLights whole;
    LightRig(scene).evaluate(settings, {}, 0, whole);
    settings.cutoff = 0.02F;
    FrameLights cut;
    LightRig(scene).evaluate(settings, {}, 0, cut);
    ASSERT_EQ(cut.lights.size(), whole.lights.size());
    for (size_t i = 0; i < cut.lights.size(); ++i) {
        EXPECT_LT(cut.radii_m[i], whole.radii_m[i]);
        EXPECT_GT(cut.radii_m[i], 1.0F);
        EXPECT_EQ(cut.lights[i].position_view, whole.lights[i].position_view);
        EXPECT_EQ(cut.lights[i].color, whole.lights[i].color);
    }
}

} // namespace
} // namespace froxel::light
